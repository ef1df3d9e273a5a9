"""A reader that keeps the fields it has read: windows, both bodies and averages read the same fields."""

BYTES = 3e8  # largest memory of the kept fields


class ReadOnce:
    """Reader of a finished run's store `reader`, with the same attributes."""

    def __init__(self, reader):
        self.reader, self.kept, self.room = reader, {}, BYTES

    def __getattr__(self, name):
        return getattr(self.reader, name)

    def __len__(self):
        return len(self.reader)

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n."""
        missing = [name for name in names if (n, name) not in self.kept]
        read = self.reader.fields(n, missing) if missing else {}
        for name, field in read.items():
            if self.room >= field.nbytes:
                self.room -= field.nbytes
                self.kept[n, name] = field
        return {name: read[name] if name in read else self.kept[n, name] for name in names}
