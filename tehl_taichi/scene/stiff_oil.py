"""Warning about isothermal films whose oil is far too stiff to slide: the result depends on viscosities beyond all
measurements.
"""

import math

from tehl_taichi.laws.circular_law import MOST_R
from tehl_taichi.laws.rheology import secant
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.scene.film_formula import central_film
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Option
from tehl_taichi.values.coded_warning import with_data


def warnings(scene):
    """Warnings: the shear stress of oil at inlet temperature and Hertz pressure would be many times its limit."""
    if not (scene.isothermal and scene.shear_law.thins):
        return
    p_H, operation = Scales.of(scene).p_H, scene.operation
    eta = math.exp(float(ln_eta(scene.oil, p_H, operation.temperature)))
    times = 1 / float(secant(scene.rheology, eta * abs(operation.u_s) / central_film(scene), p_H))
    if times > MOST_R:
        option = Option("; use --thermal to include shear heating", "; temperatures include shear heating")
        text = (f"isothermal oil of {eta:.2g} Pa s at {p_H / 1e9:.3g} GPa: its sliding would need {times:.2g} times the stress "
                f"that rheology.law = {scene.rheology.law} allows, and more under a feature. The film follows an extrapolated "
                f"viscosity (plug flow){option}")
        yield with_data(text, option, eta_Pa_s=eta)
