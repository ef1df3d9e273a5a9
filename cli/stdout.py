"""Output to stdout."""

import json
import sys


def put(text, keep="", file=None):
    """Print a line in which letters that do not print are spelled, but for those in `keep`."""
    from tehl_taichi.values.escape import printable

    print(printable(text, keep), file=file or sys.stdout, flush=file is not None)


def print_json(value):
    """One JSON object; NaN and the infinities, which JSON has not, are null."""
    from tehl_taichi.store.json_values import plain

    print(json.dumps(plain(value), allow_nan=False))
