"""Large parts of a page, packed into text: plotly.js and the numbers of the figures, as base64 of a gzip that the browser
unpacks."""

import base64
import functools
import gzip
import importlib
import json

import numpy as np

from tehl_taichi.errors import StoreError, extra
from tehl_taichi.store.json_values import plain

LEVEL = 6  # 9 takes three times as long for the numbers of figures, for 2 % less


def packed(text):
    """`text` (str) for a <script> that the page unpacks: a fifth to a half of its size."""
    return base64.b64encode(gzip.compress(text.encode(), LEVEL, mtime=0)).decode()


def check_installed():
    """Raise StoreError without what a page is made with."""
    for name in ("jinja2", "plotly"):
        try:
            importlib.import_module(name)
        except ImportError:
            raise StoreError(f"a report needs {name}: {extra('report')}") from None


@functools.cache
def library():
    """plotly.js as its Python package brings it, packed."""
    from plotly.offline import get_plotlyjs

    return packed(get_plotlyjs())


def as_json(figures):
    """Figures as JSON text; arrays are typed ones of single precision, as plotly.js reads them."""
    return json.dumps(typed(figures), allow_nan=False, separators=(",", ":"))


def typed(value):
    """`value` with {"dtype", "bdata", "shape"} in place of arrays."""
    if isinstance(value, dict):
        return {key: typed(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [typed(item) for item in value]
    if not isinstance(value, np.ndarray):
        return plain(value)
    shape = {"shape": ", ".join(map(str, value.shape))} if value.ndim > 1 else {}
    return {"dtype": "f4", "bdata": base64.b64encode(np.ascontiguousarray(value, "<f4").data).decode(), **shape}
