"""From slip to none: the same oil, and what is left out is said."""

import pytest
from commands import here as command

from tehl_taichi.march.passage import march
from tehl_taichi.scene import idle_keys, scene
from tehl_taichi.scene.film_formula import NOTICED, heat_words


def h_c(**changes):
    return next(march(scene("smooth-line").replace(**{"grid.nx": 128, **changes}))).scalars["h_c_m"]


@pytest.mark.slow
def test_the_film_has_no_step_where_slip_vanishes(taichi_cpu):
    """Heat of the inlet by formula 8 %, computed 7.6 %; the density without its thermal factor would add 3.5 %."""
    none, cold = h_c(srr=0), h_c(srr=0, **{"thermal.on": False, "oil.expansion": "always"})
    assert none == pytest.approx(h_c(srr=1e-3), rel=1e-3)
    assert cold / none - 1 == pytest.approx(0.08, abs=0.01) and "h_c by 8%" in heat_words(scene("smooth-line").replace(srr=0))
    # without heat: an inlet too slow to warm, and one just below that
    for slow, left in (({"speed": 0.05, "grid.nx": 256}, 5e-3), ({"speed": 1.5}, NOTICED)):
        assert scene("smooth-line").replace(srr=0, **slow).isothermal
        assert h_c(srr=0, **slow) == pytest.approx(h_c(srr=1e-4, **slow), rel=left)


def test_an_isothermal_film_that_is_asked_for_is_that_of_the_formulas():
    gear = scene("gear")
    assert gear.replace(srr=0).film_oil.expansion == "always"
    assert gear.replace(srr=0, **{"thermal.on": False}).film_oil.expansion == "thermal"
    assert gear.replace(srr=0, **{"oil.expansion": "never"}).film_oil.expansion == "never"


def test_the_temperature_of_a_film_without_slip_counts_in_its_density():
    gear = scene("gear").replace(srr=0)
    assert "oil.beta0" not in idle_keys.idle(gear) and "oil.beta0" in idle_keys.idle(gear.replace(**{"thermal.on": False}))


def test_a_sweep_through_no_slip_says_which_cases_compute_no_temperatures(tmp_path):
    words = "sweep", "smooth-line", "--set", "speed=0.5", "--over", "srr=-0.1,0,0.1", "--dry-run", "--out", tmp_path / "s.zarr"
    done = command(*words)
    assert "case 1 computes no temperatures" in done.stdout
    assert "no temperatures" not in command(*words, "--isothermal").stdout
