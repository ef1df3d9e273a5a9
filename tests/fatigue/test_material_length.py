"""The index of stresses averaged over fatigue.length: where it is searched, of what, with which bars, when it leads."""

import numpy as np
import pytest
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment, judged_layers, material_length
from tehl_taichi.fatigue.stress.averaging import AveragedReader
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.report import verdict
from tehl_taichi.runs.summary import search_rows

pytestmark = pytest.mark.usefixtures("taichi_cpu")
ISOTHERMAL = {"thermal.on": False, "srr": -0.12}


def found(length, cells=12, **changes):
    """{surface: summary} of a passage of formulas; its cells are 39 um wide on 12 cells a half-width."""
    scene = tehl.scene("gear").replace(**ISOTHERMAL, **changes, **{"fatigue.length": length})
    return assessment.run(scene, Rolling(scene, cells, 5), alone=False).summaries


def test_it_is_that_of_the_averaged_loads_of_both_bodies():
    both = found(100e-6)
    for name, summary in both.items():
        scene = tehl.scene("gear").replace(**ISOTHERMAL, **{"fatigue.length": 0.0, "fatigue.surfaces": name})
        wide = assessment.run(scene, AveragedReader(Rolling(scene, 12, 5), 100e-6), alone=False).summary
        own = summary["averaged"]
        assert own["length_m"] == 100e-6
        for part, other, error in ((own, wide, 1e-6), (own["below"], wide["below"], 1e-12)):
            assert part["findley_stress_max_Pa"] == pytest.approx(other["findley_stress_max_Pa"], rel=error)
            assert part["Fi_max"] == pytest.approx(part["findley_stress_max_Pa"] / 400e6)
        assert own["Fi_max"] < summary["Fi_max"] and own["below"]["Fi_max"] < summary["below"]["Fi_max"]


@pytest.mark.parametrize("length, changes", [(0.0, {}), (60e-6, {})])
def test_none_without_a_length_and_of_one_below_two_cells(length, changes):
    assert all("averaged" not in one for one in found(length, **changes).values())


def test_none_of_rough_surfaces():
    rough = tehl.scene("rough")
    assert not material_length.counts(rough, np.arange(9) * 1e-6)
    assert material_length.counts(tehl.scene("gear"), np.arange(9) * 1e-6)


def test_coarser_grids_whose_cells_are_as_long_give_their_index_at_nodes():
    """So the error of the averaged one has the steps from grid to grid in it."""
    scene = tehl.scene("gear").replace(**ISOTHERMAL, **{"fatigue.length": 80e-6})
    fine, coarse = (coarse_runs.indices(found(80e-6, cells)) for cells in (16, 8))
    assert "a:averaged_Fi_max" in fine and "a:averaged_Fi_max" not in coarse
    reader = Rolling(scene, 8, 5)
    own = coarse_runs.passage_readings(scene, Scalars(reader), Scalars(reader).scalar, found(80e-6, 8))
    assert own["a:averaged_Fi_max"].value == own["a:Fi_max"].value
    assert own["b:below_averaged_Fi_max"].value == own["b:below_Fi_max"].value


class Scalars:
    """A reader with the numbers of its steps, all one."""

    def __init__(self, reader):
        self.reader = reader

    def __getattr__(self, name):
        return getattr(self.reader, name)

    def __len__(self):
        return len(self.reader)

    def fields(self, n, names):
        found = self.reader.fields(n, [name for name in names if name != "film"])
        return found | {"film": 1e-6 + 0 * next(iter(found.values()))}

    def scalar(self, name):
        return np.ones(len(self))


def of(Fi, error, wide, wide_error):
    """A summary with an index at the surface and an averaged one."""
    return {"surface": "a", "Fi_max": Fi, "error": {"Fi_max": error}, "surface_angle_deg": 30.0,
            "averaged": {"length_m": 1e-5, "Fi_max": wide, "error": {"Fi_max": wide_error}, "surface_angle_deg": 35.0}}


@pytest.mark.parametrize("error, wide_error, leads", [(None, 0.01, True), (0.2, 0.01, False), (None, None, False)])
def test_it_leads_where_its_error_alone_is_known(error, wide_error, leads):
    """Pointwise 1.05 and averaged 0.76: the answer is no where the second leads."""
    fatigue = of(1.05, error, 0.76, wide_error)
    (where, Fi, bar), = judged_layers.all_layers({"a": fatigue})
    assert (Fi, bar) == ((0.76, 0.01) if leads else (1.05, error))
    assert ("averaged over 10 µm" in where) == leads
    tone = verdict.of_fatigue(fatigue)[2]
    assert tone == {(None, True): "no", (0.2, False): "open", (None, False): "yes"}[error, leads]


def test_both_are_printed():
    fatigue = found(100e-6)["a"]
    fatigue["averaged"]["error"] = {"Fi_max": 0.01}
    rows = [row.text_pair[0] for row in search_rows.rows_of_fatigue(fatigue)]
    assert "Fi_max at the surface" in rows and "Fi_max of averaged stresses, surface, over 100 um" in rows
    depth = fatigue["averaged"]["below"]["depth_m"] * 1e6
    assert any(row.startswith(f"Fi_max of averaged stresses, below, over 100 um, at {depth:.3g}") for row in rows)
