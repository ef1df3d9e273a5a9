"""Arrays of the caller that stay on a graphics card: launches there would copy every array there and back each time."""

import weakref

import numpy as np

from tehl_taichi.engine.language import ti

LARGE = 4096  # entries from which on an array is handed over as it is: to compare it would cost as much
_twins = {}  # address of an array: its _Twin


class _Twin:
    """The copy of a small array on the card."""

    def __init__(self, array):
        key, twins = id(array), _twins  # bound here: module names are gone when the interpreter ends
        self.array = weakref.ref(array, lambda _: twins.pop(key, None))
        self.device = ti.ndarray(ti.lang.util.to_taichi_type(array.dtype), array.shape)
        self.known = None

    def send(self):
        """Bring what has changed since."""
        array = self.array()
        if self.known is None or not np.array_equal(self.known, array):
            self.known = array.copy()
            self.device.from_numpy(self.known)

    def fetch(self):
        """Take what a kernel has written."""
        self.known = self.device.to_numpy()
        self.array()[...] = self.known


def twin_of(array):
    """The :class:`_Twin` of a small array."""
    if id(array) not in _twins:
        _twins[id(array)] = _Twin(array)
    return _twins[id(array)]


def there(array):
    """The copy of a small array on the card, as the array is now."""
    twin = twin_of(array)
    twin.send()
    return twin.device


def bind(kernel, args, writes):
    """A launch of `kernel` with these arguments, small arrays by their copies on the card; writes: numbers of the arguments
    that it fills."""
    small = {n: twin_of(a) for n, a in enumerate(args) if isinstance(a, np.ndarray) and a.size < LARGE}
    there = [small[n].device if n in small else a for n, a in enumerate(args)]

    def launch(held=args):
        for twin in small.values():
            twin.send()
        kernel(*there)
        for n in writes:
            if n in small:
                small[n].fetch()

    return launch
