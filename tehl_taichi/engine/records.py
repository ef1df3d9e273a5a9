"""Named numbers for kernels: a struct there, filled by name here.

Bound launches hold arrays by address, so the numbers may change from step to step; a struct passed by value could not.
"""

import numpy as np

from tehl_taichi.engine.language import ti


class Record:
    """Numbers of a `ti.dataclass` of f64, in the order of its members, as the array `values` that launches hold.

    Kernels read the struct with :func:`read`. Raises KeyError for a name that is not in the struct.
    """

    def __init__(self, kind, **numbers):
        self.places = {name: n for n, name in enumerate(kind.members)}
        self.values = np.zeros(len(self.places))
        self.set(**numbers)

    def set(self, **numbers):
        """Set some of the numbers."""
        for name, number in numbers.items():
            self.values[self.places[name]] = number

    def __getitem__(self, name):
        return self.values[self.places[name]]


@ti.func
def read(kind: ti.template(), values: ti.template()):
    """The struct `kind` from the values of a :class:`Record`."""
    return kind(*[values[n] for n in ti.static(range(len(kind.members)))])
