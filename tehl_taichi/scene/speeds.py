"""Conversion of the two surface speeds to mean speed and slip."""

from tehl_taichi.errors import SceneError
from tehl_taichi.values.checks import number
from tehl_taichi.values.coerce import plain


def of_surfaces(values):
    """Table [operation] with u_m and srr in place of u_a and u_b (m/s); tables without them are returned unchanged. Raises
    SceneError.
    """
    if not isinstance(values, dict):
        return values
    values = dict(values)
    if "u_a" in values or "u_b" in values:
        if not {"u_a", "u_b"} <= values.keys() or values.keys() & {"u_m", "srr"}:
            raise SceneError("operation needs u_a and u_b together, or u_m and srr")
        u_a, u_b = (plain(values.pop(key)) for key in ("u_a", "u_b"))
        number("operation.u_a", u_a, "m/s", -1e4, 1e4)
        number("operation.u_b", u_b, "m/s", -1e4, 1e4)
        u_m = 0.5 * (u_a + u_b)
        if not abs(u_m) > 0:
            raise SceneError(f"operation.u_a = {u_a:g} m/s and u_b = {u_b:g} m/s give no entrainment (mean speed 0): "
                             "there is no film and SRR has no meaning")
        values.update(u_m=u_m, srr=round((u_a - u_b) / u_m, 12))  # -0.02 of 5.94 and 6.06, as one would say it
    return values
