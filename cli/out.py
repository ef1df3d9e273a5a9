"""What goes to stdout."""

import json


def print_json(value):
    """One JSON object; NaN and the infinities, which JSON has not, are null."""
    from tehl_taichi.io.json_values import plain

    print(json.dumps(plain(value), allow_nan=False))
