"""Which key of a study matters: shares of the spread of a result, against functions whose shares are known."""

import numpy as np
import pytest
from commands import here
from tehl_cli import sweep_display

import tehl_taichi as tehl
from tehl_taichi.runs.sweep import sweeping
from tehl_taichi.runs.sweep.plan import plan

GEAR = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16})


def computed(folder, over, function, error=None, **sampled):
    """Study of a made-up Fi, a function of (SRR, height in um, law)."""
    def work(job):
        scene = job.scene
        Fi = function(scene.operation.srr, scene.features[0].height * 1e6, scene.rheology.law)
        summary = None if Fi is None else {"fatigue": {"Fi_max": Fi, "error": {"Fi_max": error}}}
        return {"status": "failed" if Fi is None else "converged", "reason": "", "seconds": 0.0, "summary": summary}

    return sweeping.run(plan(GEAR, over, **sampled), folder / "s.zarr", workers=1, keep="summary", work=work)


def shares(study):
    found = study.main_effects("fatigue_Fi_max")
    return found["shares"], found["together"]


def test_a_sum_and_a_product_have_the_shares_of_their_variances(tmp_path):
    """By hand: x = -1, 1 and y = 0, 3 vary by 1 and 2.25; their product has nothing but what both do together around x = 0."""
    over = {"srr": [-1.0, 1.0], "height": [0.1e-6, 3.1e-6]}
    found, together = shares(computed(tmp_path / "sum", over, lambda x, y, law: x + y))
    assert found == pytest.approx({"srr": 1 / 3.25, "height": 2.25 / 3.25}) and together == pytest.approx(0.0, abs=1e-9)
    found, together = shares(computed(tmp_path / "product", over, lambda x, y, law: x * (y - 1.6)))
    assert found == pytest.approx({"srr": 0.0, "height": 0.0}, abs=1e-9) and together == pytest.approx(1.0)


def test_units_offsets_and_order_of_the_keys_do_not_matter(tmp_path):
    over = {"srr": "-0.2:0.2:4", "height": "0.2e-6:1.4e-6:3", "rheology.law": ["limiting", "eyring"]}

    def Fi(x, y, law, factor=1.0, shift=0.0):
        return factor * (x + y**2 + 0.3 * x * y + (law == "eyring")) + shift

    usual, together = shares(computed(tmp_path / "a", over, Fi))
    other = shares(computed(tmp_path / "b", dict(reversed(over.items())), lambda x, y, law: Fi(x, y, law, 1e-9, 3e-9)))
    assert other[0] == pytest.approx(usual) and other[1] == pytest.approx(together)
    assert sum(usual.values()) + together == pytest.approx(1.0) and 0 < together < 0.1


def test_samples_give_the_shares_of_the_function_behind_them(tmp_path):
    """x over a length 0.6, y over 1.3, uniform: variances 0.03 and 0.3² 1.3²/12; words count as they are drawn."""
    over = {"srr": (-0.3, 0.3), "height": (0.2e-6, 1.5e-6), "rheology.law": ["limiting", "eyring"]}
    made = computed(tmp_path, over, lambda x, y, law: 0.3 * y - x + 0.2 * (law == "eyring"), samples=60)
    found, together = shares(made)
    parts = np.array([0.6**2 / 12, 0.3**2 * 1.3**2 / 12, 0.2**2 / 4])
    assert list(found.values()) == pytest.approx(parts / parts.sum(), abs=0.03) and together < 1e-9


@pytest.mark.parametrize("over, options, why", [
    ({"srr": "-0.2:0.2:5"}, {}, "only one key changes"), ({"srr": [0.1, 0.2], "height": [1e-6]}, {}, "only one key changes"),
    ({"srr": [0.1, 0.2], "height": [1e-6, 2e-6]}, {"error": 1.0}, "no more than their errors"),
    ({"srr": (-0.2, 0.2), "height": (1e-7, 1e-6)}, {"samples": 6}, "fewer than 10 cases have a result")])
def test_no_shares_without_reason(over, options, why, tmp_path):
    study = computed(tmp_path, over, lambda x, y, law: 1 + x + y, **options)
    found = study.main_effects("fatigue_Fi_max")
    assert found["shares"] == {} and why in found["why"] and study.to_dict()["main_effects"] == {}
    assert "share of the spread" not in here("show", study.path).stdout


def test_combinations_without_a_result_leave_no_shares(tmp_path):
    """The means over one key would contain the other one: 97 % and 46 % of one spread."""
    over = {"srr": [0.0, 0.1, 0.2], "height": [1e-6, 2e-6]}
    study = computed(tmp_path, over, lambda x, y, law: None if y > 1.5 and x < 0.15 else 10 * x + 0.5 * y)
    found = study.main_effects("fatigue_Fi_max")
    assert found["shares"] == {} and found["together"] is None and found["why"] == "some cases have no result"


def test_they_are_shown(tmp_path):
    """In the table, in JSON, on the page and over the panels."""
    pytest.importorskip("matplotlib")
    over = {"srr": [-0.1, 0.1, 0.3], "height": [0.1e-6, 1.1e-6], "rheology.law": ["limiting", "eyring"]}
    study = computed(tmp_path, over, lambda x, y, law: x + 0.1 * y + 0.02 * (law == "eyring"))
    found, together = shares(study)
    assert together < 1e-9 and max(found, key=found.get) == "srr"
    printed = here("show", study.path).stdout
    assert "share of the spread" in printed and f"{found['srr']:.0%}" in printed
    assert study.to_dict()["main_effects"]["judged_Fi"]["shares"] == pytest.approx(found)
    from tehl_taichi.report import study_page
    from tehl_taichi.runs.sweep import study_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    assert f"{found['srr']:.0%}" in str(study_page.of(study.path).sections[0])
    page = FigureStyle()
    titles = [ax.get_title() for ax in page.drawn(lambda: study_figures.points(page, study, "judged_Fi")).axes]
    assert titles == [f"{share:.0%} of the spread".replace("%", " %") for share in found.values()]


def test_a_study_is_read_by_names(tmp_path):
    study = computed(tmp_path, {"srr": [-0.1, 0.1], "height": [1e-6, 2e-6]}, lambda x, y, law: x + y)
    assert study["judged_Fi"] is study.values["judged_Fi"] and "judged_Fi" in study and "x" not in study
    assert list(study) == list(study.values) and study._repr_html_().count("<tr>") == 5 and "srr" in study._repr_html_()
    for wrong in ("judgedFi", 3, None):
        with pytest.raises(tehl.Error, match=rf"{wrong!r} is no column of this study.*known: judged_Fi, fatigue|is no column"):
            study[wrong]
        with pytest.raises(KeyError):
            study.main_effects(wrong)


def test_the_table_of_a_steady_study_has_its_results(tmp_path):
    """Pressure, friction and the contact alone; with a passage those of the passage."""
    def work(job):
        found = {"steady": {"h_c_m": 4e-7, "p_max_Pa": 1.9e9, "friction_coefficient": 0.05}, "contact_alone": {"Fi_max": 1.2}}
        found |= {"transient": {"p_max_Pa": 3e9}} if job.scene.transient else {}
        return {"status": "converged", "reason": "", "seconds": 0.0, "summary": found}

    for scene, there in ((tehl.scene("smooth-line"), True), (GEAR, False)):
        study = sweeping.run(plan(scene, {"load": [9e5, 1e6]}), tmp_path / scene.name, workers=1, keep="summary", work=work)
        heads = [head for _, head, _ in sweep_display.columns_of(study)]
        assert all((head in heads) == there for head in ("steady p_max GPa", "steady friction", "contact alone Fi"))
        assert sweep_display.key_heads(study.plan) == ["load N/m"] and "steady h_c um" in heads
        assert "N/m" in here("show", study.path).stdout
