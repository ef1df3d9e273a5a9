"""Store as an xarray.Dataset with a coordinate for every dimension."""

import numpy as np

from tehl_taichi.errors import StoreError, extra
from tehl_taichi.store import integrity

NAMES = {"component": ["xx", "yy", "zz", "xy", "xz", "yz"], "direction": ["x", "y", "z"],
         "of_circle": ["along dip", "along strike", "radius"]}
TEXTS = {"component": "component of the stress", "direction": "direction of the component of a vector",
         "of_circle": "centre and radius of the circle around the shear path",
         "moment": "number of the moment in a stress history; the last one is unloaded"}
ALONG_TIME = ("feature_x", "step")  # series that say which moment it is


def dataset(path):
    """Open the store at `path` as a Dataset. Raises StoreError without xarray (the `xarray` extra), and for a damaged store."""
    try:
        from tehl_taichi.store import checked_zarr
    except ImportError:
        raise StoreError(f"a dataset needs xarray: {extra('xarray')}") from None
    data = checked_zarr.opened(path, *integrity.root_of(path))
    data = data.set_coords([name for name in ALONG_TIME if name in data])
    missing = {dim: size for dim, size in data.sizes.items() if dim not in data.coords}
    return data.assign_coords({dim: _coordinate(dim, size) for dim, size in missing.items()})


def _coordinate(dim, size):
    """Coordinate of a dimension without an array: names, else numbers from 0."""
    kind = dim.removeprefix("other_").removeprefix("resolved_")  # of the other body, of the resolved part
    return dim, NAMES.get(dim, np.arange(size)), {"units": "1", "long_name": TEXTS.get(kind, f"number along {dim}")}
