"""NetCDF-4 file of a stored run: every array with its dimensions, units and long name, every attribute of the store."""

import contextlib
import io

from tehl_taichi.errors import StoreError, extra
from tehl_taichi.store import array_file
from tehl_taichi.view.export.file_format import Format

PACKED = {"zlib": True, "complevel": 1}


def write(reader, path, places):
    """Write the whole store into the file at `path`, one array in memory at a time. Raises StoreError without xarray, h5netcdf;
    OSError if the disk is full.
    """
    try:
        import h5netcdf
        import h5py  # noqa: F401  xarray's own sentence about it names no extra
        from xarray.backends import H5NetCDFStore

        from tehl_taichi.store import checked_zarr
    except ImportError as error:
        raise StoreError(f"NetCDF needs {error.name}: {extra('xarray')}") from None
    for name in reader.metadata:
        array_file.check(reader.path / name)
    with checked_zarr.opened(reader.path, reader.attrs, reader.metadata, chunks=None, decode_times=False) as data:
        for variable in data.variables.values():
            variable.encoding = {}  # zarr's codecs, which HDF5 has not
        data.attrs = {name: _plain(value) for name, value in data.attrs.items()}
        with _Patient.opened(path) as file, h5netcdf.File(file, "w") as target:
            data.dump_to_store(H5NetCDFStore(target), encoding={name: PACKED for name, array in data.items() if array.ndim})


class _Patient(io.FileIO):
    """File that keeps data which the disk refuses in memory until it is closed: HDF5 ends the process if a write fails while it
    closes.
    """

    refused = None

    @classmethod
    @contextlib.contextmanager
    def opened(cls, path):
        """Context manager: the new file at `path`. Raises OSError at the end of the block if the disk did not take all data."""
        with cls(path, "x+") as file:
            try:
                yield file
            except Exception as error:  # what HDF5 makes of bytes that are missing
                raise file.refused or error from None
            if file.refused:
                raise file.refused

    def write(self, data):
        data, done = memoryview(data).cast("B"), 0
        with self._patience():
            while not self.refused and done < len(data):
                done += self.some(data[done:])
        return len(data)

    def some(self, data):
        """Write as many of the bytes as the disk takes at once; returns their number. Raises OSError."""
        return super().write(data)

    def truncate(self, size=None):
        with self._patience():
            return super().truncate(size)
        return size

    @contextlib.contextmanager
    def _patience(self):
        try:
            yield
        except OSError as error:
            self.refused = self.refused or error


def _plain(value):
    """Attribute for NetCDF, which has no true and false."""
    return int(value) if isinstance(value, bool) else value


FORMAT = Format(name="netcdf", says="one NetCDF-4 file with everything (extra xarray)", ending=".nc", write=write)
