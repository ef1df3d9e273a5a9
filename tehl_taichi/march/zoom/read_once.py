"""A reader that keeps the fields it has read: windows, both bodies and averages read the same fields."""

from tehl_taichi.values.kept_arrays import KeptArrays

BYTES = 3e8  # largest memory of the kept fields


class ReadOnce:
    """Reader of a finished run's store `reader`, with the same attributes."""

    def __init__(self, reader):
        self.reader, self.kept = reader, KeptArrays(BYTES)

    def __getattr__(self, name):
        return getattr(self.reader, name)

    def __len__(self):
        return len(self.reader)

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n."""
        return {name: self.kept.of((n, name), lambda name=name: self.reader.fields(n, (name,))[name]) for name in names}
