"""What goes to stdout and into folders of figures."""

import json
from pathlib import Path


def print_json(value):
    """One JSON object; NaN and the infinities, which JSON has not, are null."""
    from tehl_taichi.io.json_values import plain

    print(json.dumps(plain(value), allow_nan=False))


def folder_for(figures):
    """The folder of that name, made. Raises StoreError."""
    from tehl_taichi.errors import StoreError

    try:
        Path(figures).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(f"cannot put figures into {figures}: {error.strerror or error}; --out takes a folder") from None
    return figures
