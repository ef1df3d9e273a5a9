"""Tables of unit loads that a run with windows uses again: for both bodies, for pointwise and averaged stresses."""

BYTES = 1e8


class KeptTables:
    """Arrays by key, up to BYTES in total; further ones are computed but not kept."""

    def __init__(self):
        self.kept, self.room = {}, BYTES

    def of(self, key, make):
        """The array of a key, computed by make() if it is not kept."""
        found = self.kept.get(key)
        if found is None:
            found = make()
            if self.room >= found.nbytes:
                self.room -= found.nbytes
                self.kept[key] = found
        return found
