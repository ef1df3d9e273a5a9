"""Arrays that are used again: tables of unit loads, fields of a store."""


class KeptArrays:
    """Arrays by key, up to `room` bytes in total; further ones are made but not kept."""

    def __init__(self, room):
        self.kept, self.room = {}, room

    def of(self, key, make):
        """The array of a key, made by make() if it is not kept."""
        found = self.kept.get(key)
        if found is None:
            found = make()
            if self.room >= found.nbytes:
                self.room -= found.nbytes
                self.kept[key] = found
        return found
