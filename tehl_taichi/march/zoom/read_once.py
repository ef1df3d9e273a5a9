"""A reader that reads no field twice, as far as fields find room: windows, both bodies and averages take the same ones."""

BYTES = 3e8


class ReadOnce:
    """As the store `reader` of a run that is finished."""

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
