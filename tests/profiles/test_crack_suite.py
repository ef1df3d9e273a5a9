"""`tehl bench cracks`, and the rows of the reference scene that a crack's loads are held to."""

import numpy as np
import pytest
from rolling import Rolling
from tehl_taichi.profiles import cracks, measure

from tehl_taichi.crack import growth
from tehl_taichi.crack.analysis import follow
from tehl_taichi.crack.crack_options import CrackOptions
from tehl_taichi.crack.symmetry_plane import plane_of
from tehl_taichi.runs.single_run import run_or_resume
from tehl_taichi.scene import scene


class Stored(Rolling):
    def __init__(self, description, cells):
        super().__init__(description, cells)
        self.scene = description


def test_rows_have_the_errors_of_two_grids_and_of_two_discretisations(taichi_cpu):
    bare, wanted = scene("gear").replace(**{"thermal.on": False}), {"length": 20e-6}
    entry, exit_ = cracks.rows_of("rolling", [Stored(bare, cells) for cells in (8, 12)], {"": wanted})
    coarse, fine, half = (follow(plane_of(bare, Stored(bare, cells)), bare,
                                 CrackOptions(**wanted, side="entry", elements=elements))
                          .sides["entry"] for cells, elements in ((8, 12), (12, 12), (12, 6)))
    value, grid, elements = entry.numbers["sigma1"]
    assert value == fine.start.sigma1 and grid == pytest.approx(abs(value - coarse.start.sigma1)) and grid > 0 == elements
    value, grid, elements = entry.numbers["K_first"]
    assert [value, grid, elements] == pytest.approx([fine.path.steps[0]["K_I_max"], *(
        abs(fine.path.steps[0]["K_I_max"] - other.path.steps[0]["K_I_max"]) for other in (coarse, half))])
    assert 0 < elements < 0.1 * value
    assert exit_.numbers == {} and "never in tension" in exit_.why
    text = cracks.page([entry, exit_])
    assert f"| {value / 1e6:.2f} ± {grid / 1e6:.2f}, {elements / 1e6:.2f} |" in text
    assert len({line.count("|") for line in text.splitlines()}) == 1
    alone = cracks.rows_of("rolling", [Stored(bare, 8)], {"short": wanted})[0]
    assert alone.case == "rolling, short" and np.isnan(alone.numbers["K_first"][1])
    assert " ± ?, 0.0" in cracks.page([alone])


def test_rows_are_kept_after_every_case(tmp_path, monkeypatch):
    monkeypatch.setattr(cracks, "_stores", lambda *job: ["store"])
    monkeypatch.setattr(cracks, "rows_of", lambda name, *more: [cracks.CrackRow(name, "entry", {}, "", "closed")])
    so_far = [[row.case for row in rows] for rows in cracks.run(tmp_path, quick=True)]
    assert so_far == [list(cracks.cases(quick=True))[:count] for count in (1, 2, 3)]


def test_cases_and_their_conditions():
    assert len(cracks.cases()) == 12 and len(cracks.cases(quick=True)) == 3
    for wanted in cracks.CONDITIONS.values():
        CrackOptions(**wanted)


ROWS = {  # side: tension (Pa) and its tolerance, place (m), moment (a), lean, chords, K_I at 5 um
    -0.12: ("entry", 365e6, 0.05, -37e-6, -0.98, "with rolling", {"10": 60, "20": 43, "40": 30}, 0.68e6),
    0.12: ("exit", 495e6, 0.10, 36e-6, 0.96, "against rolling", {"10": 42, "20": 30, "40": 22}, 0.71e6)}


@pytest.fixture(scope="module", params=[(-0.12, 128), (0.12, 256), (-0.12, 256)], ids=str)
def stored(request, taichi_cpu, tmp_path_factory):
    """(slip, store) of the reference scene without thermal stress, as the rows are."""
    srr, nx = request.param
    grid = {"grid.nx": nx, "grid.ny": nx // 4, "fatigue.thermal_stress": False, **measure.BARE}
    return srr, run_or_resume(scene("gear").replace(srr=srr, **grid), tmp_path_factory.mktemp("crack") / "gear.zarr").store


@pytest.mark.slow
def test_the_reference_scene(stored):
    srr, saved = stored
    name, tension, rel, place, moment, lean, chords, K_I = ROWS[srr]
    plane = plane_of(saved.scene, saved)
    side = follow(plane, saved.scene, CrackOptions(side=name)).summary["sides"][name]
    cell = plane.x[1] - plane.x[0]
    assert side["sigma1_surface_Pa"] == pytest.approx(tension, rel=rel)
    assert side["start_x_m"] == pytest.approx(place, abs=cell)
    assert side["moment_x_m"] / plane.a == pytest.approx(moment, abs=0.05)
    assert side["trajectory"]["lean"] == lean
    assert side["trajectory"]["chord_deg_at_um"] == pytest.approx(chords, abs=3)
    assert side["K"][0]["K_I_max"] == pytest.approx(K_I, rel=0.06) and side["unsettled"] == 0


@pytest.mark.slow
def test_straight_cracks_of_the_reference_scene_hardly_depend_on_their_elements(stored):
    """24 against 48 elements, at 15 to 165 degrees, 20 um: 1 % of K_I and of the range of K_II; all moments settle."""
    _, saved = stored
    plane, E_star = plane_of(saved.scene, saved), saved.scene.body_a.E / (1 - saved.scene.body_a.nu**2)
    for degrees in (15, 30, 45, 90, 135, 165):
        path = -37e-6 + np.array([0, 20e-6 * np.exp(1j * np.radians(degrees))])
        coarse, fine = (growth.load_crack(plane, path, CrackOptions(), E_star, count) for count in (24, 48))
        assert coarse.missed == fine.missed == 0
        np.testing.assert_allclose(coarse.K[0].max(), fine.K[0].max(), rtol=0.01)
        np.testing.assert_allclose(np.ptp(coarse.K[1]), np.ptp(fine.K[1]), rtol=0.01)


@pytest.mark.slow
def test_residual_stress_shuts_the_reference_crack(stored):
    """A vertical crack of 5 um under -200 MPa has no K_I at any moment."""
    srr, saved = stored
    plane = plane_of(saved.scene, saved, -200e6)
    x = ROWS[srr][3]
    crack = growth.load_crack(plane, x + np.array([0, 5e-6j]), CrackOptions(), 206e9 / 0.91)
    assert (crack.K[0] == 0).all()
    assert (crack.touching > 0).any()
