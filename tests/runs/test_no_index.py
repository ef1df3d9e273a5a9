"""A film with more shear than any oil gives no index of fatigue: the reason, and the index of the pressure alone."""

import json

import pytest

import tehl_taichi as tehl

NEWTONIAN = {"rheology.law": "newtonian", "thermal.on": False, "grid.nx": 64, "grid.ny": 16, "time.steps": 8}


@pytest.fixture(scope="module")
def run(taichi_cpu, tmp_path_factory):
    return tehl.run(tehl.scene("gear").replace(srr=-0.12, **NEWTONIAN), tmp_path_factory.mktemp("none") / "none.zarr")


def test_the_summary_has_no_index_and_says_why(run):
    found = json.loads(json.dumps(run.summary["fatigue"]))
    assert found["Fi_max"] is None and found["findley_stress_max_Pa"] is None
    assert "which no oil reaches" in found["unknown"]["Fi_max"]
    alone = run.fatigue(shear=False).summary  # asked for the pressure alone
    assert found["pressure_alone"]["Fi_max"] == alone["Fi_max"] > 0
    assert found["pressure_alone"]["below"]["Fi_max"] == alone["below"]["Fi_max"]


def test_a_search_with_other_constants_gives_no_index_either(run):
    again = run.fatigue(kappa=0.5).summary
    assert again["Fi_max"] is None and again["pressure_alone"]["kappa_F"] == 0.5


def test_every_view_says_so(run, tmp_path):
    from tehl_taichi.report import verdict
    from tehl_taichi.runs.summary.summary_rows import rows_of
    from tehl_taichi.runs.sweep import summary_columns
    from tehl_taichi.view.figures.run_figures import write_all

    rows = rows_of(run.summary)
    first = next(row for row in rows if row.what.startswith("Fi_max"))
    assert first.value.startswith("no value: the friction") and first.number is None
    assert all("pressure alone" in row.what for row in rows[rows.index(first) + 1 :] if "Fi" in row.what)
    answer = verdict.of(run.store)
    assert answer.headline.startswith("No verdict: the friction") and answer.tone == "open"
    assert "fatigue_Fi_max" not in summary_columns.numbers(run.summary) \
        and "fatigue_pressure_alone_Fi_max" in summary_columns.numbers(run.summary)
    page = tehl.report(run, tmp_path / "page.html")
    assert "No verdict" in page.read_text() and "pressure alone" in page.read_text()
    assert len(write_all(run.store, tmp_path / "figures")) > 2


def test_a_limited_stress_keeps_its_index(taichi_cpu, tmp_path):
    run = tehl.run(tehl.scene("gear").replace(srr=-0.12, **{**NEWTONIAN, "rheology.law": "limiting"}), tmp_path / "index.zarr")
    assert run.summary["fatigue"]["Fi_max"] > 0 and "pressure_alone" not in run.summary["fatigue"]


def test_no_crack_follows_from_shear_that_no_oil_carries(run):
    for options in ({}, {"surface": "a"}):
        with pytest.raises(tehl.SceneError, match="no crack follows from this run: the friction"):
            tehl.crack(run, **options)
    assert run["Fi_max"].reason.startswith("the friction") and run["Fi_max"].value != run["Fi_max"].value
