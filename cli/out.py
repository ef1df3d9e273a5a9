"""What goes to stdout and into folders of figures."""

import json


def print_json(value):
    """One JSON object; NaN and the infinities, which JSON has not, are null."""
    from tehl_taichi.io.json_values import plain

    print(json.dumps(plain(value), allow_nan=False))


def folder_for(figures):
    """The folder of that name, made. Raises StoreError."""
    from tehl_taichi.figures.run_figures import made

    return made(figures)
