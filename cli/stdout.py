"""Output to stdout."""

import json
import sys

from tehl_taichi.values.escape import printable


def put(text, keep="", file=None):
    """Print a line with non-printing letters spelled, except those in `keep`."""
    print(printable(text, keep), file=file or sys.stdout, flush=file is not None)


def print_json(value):
    """Print one JSON object; NaN and infinities, which JSON lacks, become null."""
    from tehl_taichi.store.json_values import plain

    print(json.dumps(plain(value), allow_nan=False))
