"""Oil without a shear law."""

from tehl_taichi.engine.pointwise import pointwise
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.values.registry import Checked


@pointwise
def stress(rheology, newtonian, p):
    """The Newtonian stress, unchanged."""
    return newtonian


@pointwise
def flow(rheology, wall, newtonian, p):
    return 1.0 + 0.0 * wall, 0.0 * wall, 0.0 * wall, 0.0 * wall


@pointwise
def mean_stress(rheology, wall, newtonian, p):
    """The Newtonian stress, whatever the pressure gradient."""
    return newtonian


NEWTONIAN = ShearLaw(
    name="newtonian", says="stress = eta * (shear rate), as in isothermal film formulas; its friction is higher than that of "
                           "any oil",
    source="Newton", numbers={}, stress=stress, flow=flow,
    mean_stress=mean_stress, thins=False,
    checked=(Checked("by definition: 3 MPa of 3 MPa", 3e6, lambda: stress(NEWTONIAN.having(), 3e6, 1e9)),))
