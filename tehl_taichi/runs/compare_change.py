"""Change between two numbers, compared with their error bars."""

MANY = 9.0  # relative change from which a factor is read better than per cent
NOT_SEPARATED = "not separated"  # the error bars of both numbers overlap


def are_separated(first, second):
    """Whether the error bars of two (value, error bar or None) do not overlap; None if an unknown bar decides."""
    bars = [error for _, error in (first, second) if error is not None]
    if bars and abs(second[0] - first[0]) <= sum(bars):
        return False
    return True if len(bars) == 2 else None


def change(first, second, nothing=0.0, unit=""):
    """Text of the change between two (value, error bar or None): in %, as a factor, in K for temperatures (unit "degC").

    NOT_SEPARATED if the bars overlap; "" if the first value is nearly `nothing` or 0 within its bar, and for equal numbers.
    """
    (a, error), (b, _) = first, second
    if a == b:
        return ""
    if are_separated(first, second) is False:
        return NOT_SEPARATED
    if unit == "degC":
        return f"{b - a:+.1f} K"
    if abs(a) <= max(error or 0.0, nothing):
        return ""
    return _relative((b - a) / abs(a), b / a)


def _relative(part, factor):
    if part >= MANY:
        return f"x {factor:.0f}"
    return f"{part:+.0%}" if abs(part) >= 0.1 else f"{100 * part:+.2g}%"
