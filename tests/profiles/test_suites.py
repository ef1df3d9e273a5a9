"""The speed, scaling and profile suites: they measure what they say, in processes of their own."""

import time
from concurrent.futures.process import BrokenProcessPool
from types import SimpleNamespace

import pytest
from tehl_taichi.profiles import accuracy, measure, scaling, speed

from tehl_taichi.engine import runtime
from tehl_taichi.scene import SceneError, grid_for_error, scene


def small(**changes):
    return scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16, **changes})


def test_fresh_processes_have_their_own_threads():
    assert [measure.fresh(count, runtime.ensure)["threads"] for count in (1, 3)] == [1, 3]


def test_fresh_processes_run_on_the_card_that_the_environment_names(monkeypatch):
    """There is none of this name, so the process does not start."""
    monkeypatch.setenv("TEHL_ARCH", "metal")
    with pytest.raises(BrokenProcessPool):
        measure.fresh(1, runtime.ensure)


def test_a_passage_is_timed(taichi_cpu):
    timing = measure.passage(small(), 3)
    assert 0 < timing.step_s < timing.passage_s and timing.newton >= 1 and timing.cycles > 1 and timing.memory_mb > 50
    assert timing.passage_s == pytest.approx(timing.start_s + 48 * timing.step_s)


def test_every_field_of_the_tables_has_its_bytes():
    import numpy as np
    from tehl_taichi.profiles import traffic

    from tehl_taichi.heat import film_tables
    from tehl_taichi.pressure import fields

    assert sum(np.size(getattr(fields, name)) for name in traffic.IN_J) == fields.NROWS_LINEAR
    assert len(traffic.IN_S) == fields.NROWS_THERMAL and len(traffic.IN_Z) == film_tables.KEPT + 1
    assert len(traffic.IN_C) == film_tables.SINGLES


def test_bytes_of_a_kernel():
    import numpy as np
    from tehl_taichi.profiles import traffic

    from tehl_taichi.engine.simd import W
    from tehl_taichi.pressure import fields, reynolds

    G = np.zeros((1, fields.NCOLS))
    G[0, [fields.NX, fields.NY]] = 16, 8
    right = np.zeros(17 * (8 // W + 1) * W, np.float32)
    # twelve rows of the Jacobian, its scale, pressure and film changes; in double precision the film and where it touches
    moved = (15 + 2 * 2) * right.nbytes + right.nbytes
    table = SimpleNamespace(dtype="f32")
    assert traffic.bytes_of(reynolds.contact_right, (table, table, G, right, True)) == moved


def test_charts_and_files(tmp_path):
    plt = pytest.importorskip("matplotlib.pyplot")
    rows = [{"nx": nx, "ny": nx // 4, "threads": count, "step_ms": 1.0, "node_ns": 2.0, "newton": 2.0, "cycles": 9.0,
             "memory_mb": 100.0, "speed_up": speed_up}
            for nx, count, speed_up in ((64, 4, None), (128, 1, 1.0), (128, 4, 2.5))]
    scaling.chart(plt, rows).savefig(tmp_path / "scaling.png")
    speed.chart(plt, [{"what": "a", "seconds": 2.0, "target": 1.0}]).savefig(tmp_path / "speed.png")
    path = measure.save(tmp_path, "scaling", measure.result(rows))
    assert "machine" in path.read_text() and (tmp_path / "scaling.png").stat().st_size > 1000


def test_more_cores_gain_what_jobs_and_the_serial_part_allow():
    assert scaling.modelled(2.0, 2, 64, 64) == pytest.approx(64)  # nothing serial, a job for every core
    assert scaling.modelled(2.0, 2, 64, 48) == pytest.approx(32)  # some cores have two jobs
    assert scaling.modelled(1.0, 2, 64, 64) == 1.0 and scaling.modelled(1.0, 2, 1, 8) == 1.0
    half = scaling.modelled(1 / 0.75, 2, 1000, 1000)  # half of it is serial
    assert half == pytest.approx(1 / 0.5005, rel=1e-3) and scaling.modelled(1.4, 2, 17, 2) == pytest.approx(1.4)


def test_orders_and_limits():
    limit, order = accuracy.extrapolated([1.0 + 0.16, 1.0 + 0.04, 1.0 + 0.01])
    assert limit == pytest.approx(1.0) and order == pytest.approx(2.0)
    found = [(nx, 0.1 * nx, {"h_c_m": 1.0 + 640.0 / nx**2}) for nx in (64, 128, 256, 512)]
    rows = accuracy.judged("steady line", found)
    assert [row["error"] for row in rows] == pytest.approx([640.0 / nx**2 for nx, _, _ in found], rel=1e-6)
    assert accuracy.enough(rows) == [("steady line", "h_c_m", pytest.approx(2.0), [128, 256, None])]


def test_runs_with_a_window_are_held_against_the_limit_of_the_grids():
    found = [(nx, 0.1 * nx, {"Fi_max": 1.0 + 640.0 / nx**2}) for nx in (64, 128, 256)]
    rows = accuracy.judged("passage", found, [(64, 4, 9.0, {"Fi_max": 1.0 - 640.0 / 256**2})])
    alone = accuracy.judged("passage", found)
    window, = (row for row in rows if "setting" in row)
    assert window["setting"] == "64 zoom 4" and window["error"] == pytest.approx(alone[2]["error"]) and window["seconds"] == 9.0
    assert [row["front"] for row in rows] == [1, 0, 0, 1]  # as exact as the finest grid, and faster
    assert accuracy.enough(rows) == accuracy.enough(alone) and accuracy.grid_errors(rows) == accuracy.grid_errors(alone)


def test_the_chart_names_every_run_once_above_its_largest_error():
    plt = pytest.importorskip("matplotlib.pyplot")
    found = [(nx, 0.1 * nx, {"h_min_m": 1.0 + 640.0 / nx**2, "p_max_Pa": 1.0 + 6.4 / nx**2}) for nx in (64, 128, 256)]
    rows = accuracy.judged("passage", found, [(64, 4, 6.5, {"h_min_m": 1.01, "p_max_Pa": 1.02})])
    ax, = accuracy.chart(plt, rows).axes
    marked = {text.get_text(): text for text in ax.texts}
    seconds = {"1": (6.4, "64"), "2": (6.5, "64 zoom 4"), "3": (12.8, "128"), "4": (25.6, "256")}
    assert {number: text.xy[0] for number, text in marked.items()} == {number: at for number, (at, _) in seconds.items()}
    assert all(text.xy[1] == max(row["error"] for row in rows if row["seconds"] == text.xy[0]) for text in marked.values())
    assert marked["2"].xyann[1] > marked["1"].xyann[1] == marked["3"].xyann[1]
    assert ax.get_xlabel().replace("\u00a0", " ").split("\n", 1)[1].split("; ") == [
        f"{number}: {name}" for number, (_, name) in seconds.items()]


@pytest.mark.slow
def test_a_window_on_a_coarse_grid_gives_what_a_fine_grid_does(taichi_cpu):
    coarse, fine = (accuracy.passage_values(accuracy.scene_of("passage", nx)) for nx in (64, 256))
    window = accuracy.zoomed_values(accuracy.scene_of("passage", 64), 4)
    for quantity, within in (("h_min_m", 0.01), ("p_max_Pa", 5e-4), ("Fi_max", 0.01)):
        assert abs(window[quantity] / fine[quantity] - 1) < within < abs(coarse[quantity] / fine[quantity] - 1), quantity


def test_the_front_of_error_against_run_time():
    rows = [{"seconds": s, "error": e} for s, e in ((1, 0.1), (2, 0.2), (3, 0.05), (4, 0.05), (0.5, 0.3))]
    assert [row["front"] for row in accuracy.marked(rows)] == [1, 0, 1, 0, 1]


def test_error_against_run_time_of_a_line(taichi_cpu):
    found = [(nx, 1.0, accuracy.solve("steady line", nx)) for nx in (64, 128, 256)]
    # 0.33 %, 0.025 %, order 1.87: 1.91 of Newtonian oil, 1.93 of sheared oil that flows by the secant of its law
    rows = [row for row in accuracy.judged("steady line", found) if row["quantity"] == "h_c_m"]
    assert rows[0]["error"] > 10 * rows[2]["error"] and rows[2]["error"] < 5e-4 and rows[0]["order"] > 1.85


def test_a_target_error_chooses_the_grid():
    line, gear = scene("smooth-line").replace(**{"thermal.on": False}), scene("gear").replace(**{"thermal.on": False})
    errors, passage = ({int(nx): error for nx, error in grid_for_error.families()[family]["errors"].items()}
                       for family in ("steady line", "passage"))
    assert grid_for_error.grid_for(line, errors[256])[0] == 256 and grid_for_error.grid_for(line, errors[1024] / 2)[0] == 2048
    assert 256 < grid_for_error.grid_for(line, 0.5 * (errors[256] + errors[512]))[0] <= 512
    assert grid_for_error.grid_for(gear, passage[256]) == (256, 64)
    # half as wide a feature, twice as wide a domain: twice the columns each
    narrow = {"width": gear.features[0].width / 2}
    for changes in (narrow, {"grid.x_min": 2 * gear.grid.x_min, "grid.x_max": 2 * gear.grid.x_max}):
        assert grid_for_error.grid_for(gear.replace(**changes), passage[256])[0] == 512
    with pytest.raises(SceneError, match="at most 2048, which give"):
        grid_for_error.grid_for(gear, 1e-4)


def test_the_bench_writes_what_the_target_error_reads():
    rows = [{"family": "passage", "columns": nx, "quantity": quantity, "error": factor / nx}
            for nx in (64, 128) for quantity, factor in (("h_min_m", 2.0), ("Fi_max", 1.0), ("film_max_C", 9.0))]
    settings = {"family": "settings, 128 columns", "columns": 128, "quantity": "h_min_m", "error": 1.0, "setting": "as it is"}
    found = accuracy.grid_errors([*rows, settings])
    assert found == {"passage": {"columns_per_width": pytest.approx(4.0 / (200e-6 / 0.3622e-3), rel=1e-3),
                                 "errors": {64: 0.031, 128: 0.016}}}
    assert found.keys() <= grid_for_error.families().keys() and found["passage"].keys() \
        == grid_for_error.families()["passage"].keys()


def test_times_of_the_bench_leave_compiling_out(monkeypatch):
    seconds = iter((0.0, 0.3, 0.3, 0.3))  # spent on binding kernels: 0.3 s in the first call

    monkeypatch.setattr(accuracy, "binding_seconds", lambda: next(seconds))
    monkeypatch.setattr(accuracy, "AGAIN", 0.2)  # a first call as long as that is not repeated unless it compiled
    calls = []

    def work():
        calls.append(1)
        time.sleep(0.55 if len(calls) == 1 else 0.25)

    assert accuracy.timed(work)[0] == pytest.approx(0.25, abs=0.1) and len(calls) == 2


def test_orders_that_do_not_exist_are_none():
    assert accuracy.extrapolated([1.0, 1.1, 1.05])[1] is None


@pytest.mark.parametrize("columns", ["COLUMNS", "QUICK"])
def test_every_grid_of_the_accuracy_suite_is_allowed(columns):
    for family, counts in getattr(accuracy, columns).items():
        assert [accuracy.scene_of(family, nx).grid.nx for nx in counts] == list(counts)
