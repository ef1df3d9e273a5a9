"""A number with its error bar, unit, and the reason if the error is not known."""

import math
from dataclasses import dataclass

from tehl_taichi.errors import NoArithmetic
from tehl_taichi.values.digits import printed_unit, with_error

REFUSED = ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "floordiv", "rfloordiv", "mod", "rmod", "divmod",
           "rdivmod", "pow", "rpow", "neg", "pos", "abs", "int", "round", "trunc", "lt", "le", "gt", "ge", "array_ufunc")


@dataclass(frozen=True)
class Quantity:
    """A number of a summary with its error; `run["p_max"]` returns one.

    Attributes
    ----------
    value : float
          In SI units (temperatures in deg C); nan if there is none, for the `reason`.
    error : float or None
          Estimated discretisation error, in the same unit; None if it is unknown.
    unit : str
          "" for a pure number.
    reason : str
          Reason why the error is unknown; "" if it is known, or if the number has none.
    name : str
          Its place in the summary, "transient.p_max_Pa" for instance.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> p = tehl.Quantity(3.114e9, 0.021e9, "Pa", name="transient.p_max_Pa")
    >>> print(p)
    3.114 ± 0.021 GPa
    >>> float(p), p.relative < 0.01
    (3114000000.0, True)
    >>> print(tehl.Quantity(3.114e9, None, "Pa", "a peak of 8% is only a few cells wide"))
    3.114 GPa, error unknown (a peak of 8% is only a few cells wide)

    Calculate with the parts; operators are refused:

    >>> p.value / 1e9
    3.114
    >>> p / 1e9
    Traceback (most recent call last):
    ...
    tehl_taichi.errors.NoArithmetic: transient.p_max_Pa has an error and a unit: calculate with its `.value` (Pa) and `.error`
    """

    value: float
    error: float | None = None
    unit: str = ""
    reason: str = ""
    name: str = ""

    def __float__(self) -> float:
        return float(self.value)

    def __format__(self, spec):
        return format(self.value, spec) if spec else str(self)

    @property
    def relative(self) -> float | None:
        """Error over value; None if one of them is unknown or the value is 0."""
        return None if self.error is None or not self.value else abs(self.error / self.value)

    def __str__(self):
        if math.isnan(self.value):
            return f"no value ({self.reason})"
        factor, unit = printed_unit(self.unit, self.value)
        unit = {"degC": "°C"}.get(unit, unit)
        if self.error is not None:
            return with_error(self.value * factor, self.error * factor, unit)
        why = f", error unknown ({self.reason})" if self.reason else ""
        return with_error(self.value * factor, None, unit) + why

    def __repr__(self):
        return f"<{self.name or 'Quantity'}: {self}>"

    def _refuse(self, *_, **__):
        """Refuse an operator, which would have to guess what becomes of the error and the unit."""
        unit = f" ({self.unit})" if self.unit else ""
        name = self.name or "a Quantity"
        raise NoArithmetic(f"{name} has an error and a unit: calculate with its `.value`{unit} and `.error`")


for operator in REFUSED:
    setattr(Quantity, f"__{operator}__", Quantity._refuse)
