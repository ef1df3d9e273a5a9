"""The largest temperature is that of the profile across the film, not of its nodes."""

import numpy as np
import pytest

from tehl_taichi.heat.chebyshev import chebyshev, largest


def nodes(count):
    return chebyshev(count)[0]


@pytest.mark.parametrize("peak", [0.5, 0.43, 0.27, 0.9, 1.0, 0.0])
def test_the_maximum_of_a_parabola_between_nodes(peak):
    T = 90 + 100 * (1 - (nodes(9) - peak) ** 2)
    assert largest(T[:, None, None]) == pytest.approx(190, abs=1e-9)


def test_against_fine_sampling_over_many_profiles():
    rng, zeta = np.random.default_rng(3), np.linspace(0, 1, 20001)
    from numpy.polynomial import chebyshev as series

    coefficients = rng.normal(size=(9, 40)) * np.array([1, 1, 1, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01])[:, None]
    T = series.chebval(2 * nodes(9) - 1, coefficients).T.reshape(9, 5, 8)
    exact = series.chebval(2 * zeta - 1, coefficients).max()
    assert largest(T) == pytest.approx(exact, abs=1e-6) and largest(T) >= T.max()


def test_a_cold_film_is_as_warm_as_it_is():
    assert largest(np.full((9, 3, 4), 90.0)) == pytest.approx(90.0, abs=1e-12)


@pytest.mark.slow
@pytest.mark.usefixtures("taichi_cpu")
def test_nine_nodes_tell_what_seventeen_do():
    """Gear, SRR -0.75: at the nodes 209.6 and 211.5 degC on 256 columns."""
    from tehl_taichi.march.passage import march
    from tehl_taichi.scene import scene

    found = []
    for count in (9, 17):
        description = scene("smooth-line").replace(**{"thermal.on": True, "srr": -0.75, "grid.nx": 64, "thermal.nodes": count})
        found.append(next(march(description)).scalars["film_max_C"])
    assert found[0] == pytest.approx(found[1], abs=0.3) and found[1] > 150
