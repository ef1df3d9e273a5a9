"""One row of a printed summary: quantity, value with its error and unit."""

from dataclasses import dataclass

from tehl_taichi.values.digits import micrometres, with_error
from tehl_taichi.values.summary_units import nothing_of
from tehl_taichi.values.summary_values import error_of


@dataclass(frozen=True)
class SummaryRow:
    """what: the quantity, equal words for every run; value: with error and unit; number: the value alone if its relative change
    has a meaning; where: place of this value, completes `what`; note: text after the value; part: of the fatigue search, else
    ""; error: bar of the number; nothing: size below which the number counts as zero.
    """

    what: str
    value: str
    number: float | None = None
    where: str = ""
    note: str = ""
    part: str = ""
    error: float | None = None
    nothing: float = 0.0

    @property
    def text_pair(self):
        """(quantity, value) as printed."""
        return self.what + self.where, self.value + self.note


def row_of(values, key, what, factor=1, unit="", **more):
    """SummaryRow of one of the values with its error."""
    return SummaryRow(what, quantity(values, key, factor, unit), values[key], error=error_of(values, key),
                      nothing=nothing_of(key), **more)


def quantity(values, name, factor=1, unit=""):
    """Text 'value ± error unit' of one of the values; three digits if the error is not known."""
    value, error = values[name] * factor, error_of(values, name)
    if error is None:
        return f"{with_error(value, None, unit, 3)} (error unknown)"
    return with_error(value, error * factor, unit)


def at_depth(values):
    """Text after a quantity: the depth of its place."""
    return f", at {depth_text(values)}"


def depth_text(values):
    """Text of the depth of a place."""
    return f"{micrometres(values['depth_m'])} um"
