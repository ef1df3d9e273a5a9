"""Numbers with names that kernels take: a struct there, filled by name here.

Bound launches hold arrays by address, so that numbers may change from step to step; a struct handed over by value could not.
"""

import numpy as np

from tehl_taichi.engine.language import ti


class Record:
    """The numbers of a `ti.dataclass` of f64, in the order of its members, as the array `values` that launches hold.

    Kernels get the struct back by :func:`read`. Raises KeyError for a name that the struct does not have.
    """

    def __init__(self, kind, **numbers):
        self.places = {name: n for n, name in enumerate(kind.members)}
        self.values = np.zeros(len(self.places))
        self.set(**numbers)

    def set(self, **numbers):
        """Set some of the numbers, the others stay."""
        for name, number in numbers.items():
            self.values[self.places[name]] = number

    def __getitem__(self, name):
        return self.values[self.places[name]]


@ti.func
def read(kind: ti.template(), values: ti.template()):
    """The struct `kind` of a :class:`Record`'s values."""
    return kind(*[values[n] for n in ti.static(range(len(kind.members)))])
