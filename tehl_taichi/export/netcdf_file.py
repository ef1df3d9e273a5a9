"""A stored run as one NetCDF-4 file: every array with its dimensions, units and long name, every attribute of the store."""

from tehl_taichi.errors import StoreError, extra
from tehl_taichi.export.file_format import Format

PACKED = {"zlib": True, "complevel": 1}


def write(reader, path, places):
    """The whole store into the file at `path`; one array at a time is in memory. Raises StoreError without xarray, h5netcdf."""
    try:
        import h5netcdf  # noqa: F401  xarray's own sentence about it names no extra
        import h5py  # noqa: F401
        import xarray
    except ImportError as error:
        raise StoreError(f"NetCDF needs {error.name}: {extra('xarray')}") from None
    with xarray.open_zarr(reader.path, chunks=None, decode_times=False) as data:
        for variable in data.variables.values():
            variable.encoding = {}  # zarr's codecs, which HDF5 has not
        data.attrs = {name: _plain(value) for name, value in data.attrs.items()}
        data.to_netcdf(path, engine="h5netcdf", encoding={name: PACKED for name, array in data.items() if array.ndim})


def _plain(value):
    """An attribute as NetCDF has it: no true and false."""
    return int(value) if isinstance(value, bool) else value


FORMAT = Format(name="netcdf", says="one NetCDF-4 file with everything (extra xarray)", ending=".nc", write=write)
