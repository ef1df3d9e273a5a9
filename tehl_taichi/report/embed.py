"""Packing of large parts of a page as text: plotly.js and the numbers of the figures, base64 of a gzip that the browser
unpacks.
"""

import base64
import functools
import gzip
import importlib
import json

import numpy as np

from tehl_taichi.errors import StoreError, extra
from tehl_taichi.store.json_values import plain

LEVEL = 6  # 9 takes three times as long for the numbers of figures, for 2 % less


def pack(text):
    """Packed text (str) for a <script> of the page: a fifth to a half of the size."""
    return base64.b64encode(gzip.compress(text.encode(), LEVEL, mtime=0)).decode()


def check_installed():
    """Raise StoreError if a library for pages is missing."""
    for name in ("jinja2", "plotly"):
        try:
            importlib.import_module(name)
        except ImportError:
            raise StoreError(f"a report needs {name}: {extra('report')}") from None


@functools.cache
def library():
    """plotly.js from its Python package, packed."""
    from plotly.offline import get_plotlyjs

    return pack(get_plotlyjs())


def as_json(figures):
    """Figures as JSON text; arrays are typed, in single precision, as plotly.js reads them."""
    return json.dumps(typed_arrays(figures), allow_nan=False, separators=(",", ":"))


def typed_arrays(value):
    """`value` with {"dtype", "bdata", "shape"} in place of arrays."""
    if isinstance(value, dict):
        return {key: typed_arrays(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [typed_arrays(item) for item in value]
    if not isinstance(value, np.ndarray):
        return plain(value)
    shape = {"shape": ", ".join(map(str, value.shape))} if value.ndim > 1 else {}
    return {"dtype": "f4", "bdata": base64.b64encode(np.ascontiguousarray(value, "<f4").data).decode(), **shape}
