"""Tables of unit loads that both bodies, pointwise and averaged stresses of a run with windows share."""

BYTES = 1e8


class KeptTables:
    """Arrays by their key, as many as find room."""

    def __init__(self):
        self.kept, self.room = {}, BYTES

    def of(self, key, make):
        """The array of a key, made by make() where it is not kept."""
        found = self.kept.get(key)
        if found is None:
            found = make()
            if self.room >= found.nbytes:
                self.room -= found.nbytes
                self.kept[key] = found
        return found
