"""`tehl run`, `tehl resume` and `tehl zoom`."""

from pathlib import Path
from typing import Any, List, Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.amount import AUTO, number, whole_or_auto
from tehl_cli.idle_options import say_idle
from tehl_cli.live_display import Live, say
from tehl_cli.scene_options import GRIDS, changes_of, check_rows
from tehl_cli.stdout import print_json, put
from tehl_cli.tables import summary_table
from tehl_cli.timing import print_budget, time_budget

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.escape import typed


def run(
    scene: str = typer.Argument("gear", help="built-in name (see `tehl scenes`), TOML file, or store to repeat"),
    context: typer.Context = None,
    srr: Optional[float] = number("slide-roll ratio (u_a - u_b)/u_m; negative in the dedendum"),
    load: Optional[float] = number("load, N/m (line contact) or N (point contact)"),
    hertz_pressure: Optional[float] = number("Hertz pressure, Pa (instead of a load)"),
    speed: Optional[float] = number("mean surface speed u_m, m/s"),
    temperature: usual.Temperature = None,
    oil: usual.Oil = None,
    height: usual.Height = None,
    width: usual.FeatureWidth = None,
    set_: Optional[List[str]] = typer.Option(None, "--set", help="any scene value, dotted.key=value; repeatable"),
    grid: usual.Grid = None,
    target_error: Optional[str] = typer.Option(None, help="choose the grid for this relative error, for example 1% (see "
                                                          "`tehl bench accuracy`)"),
    steady: bool = typer.Option(False, "--steady", help="compute the steady contact only"),
    thermal: usual.Thermal = None,
    fatigue: usual.Fatigue = None,
    zoom: Any = typer.Option(None, parser=whole_or_auto, metavar="2|4|8|16|auto",
                             help="add a fine window that moves with the feature, 2, 4, 8 or 16 times as fine as the grid; "
                                  "auto: no window if the grid suffices, otherwise the first factor that does"),
    run_in: Optional[int] = typer.Option(None, help="largest number of run-in passages before the stored passage; steel "
                                                    "of bodies with a yield stress can yield in them"),
    estimate_error: Optional[bool] = typer.Option(None, "--estimate-error/--no-estimate-error",
                                                  help="estimate errors by coarse-grid runs (default: for all but very short "
                                                       "passages)"),
    kappa: usual.Kappa = None, endurance: usual.Endurance = None,
    bending_limit: usual.BendingLimit = None, torsion_limit: usual.TorsionLimit = None,
    steps: Optional[int] = typer.Option(None, help="stop after this many time steps (0: steady start and an estimate of the "
                                                   "run time); `tehl resume` continues"),
    out: Optional[Path] = typer.Option(None, help="store to write (default: runs/SCENE-N.zarr)"),
    force: bool = typer.Option(False, "--force", help="replace an existing store once the new one has its first entry"),
    dry_run: usual.DryRun = False,
    arch: Optional[str] = typer.Option(None, hidden=True),  # cpu; cuda is experimental, see TEHL_ARCH
    threads: usual.Threads = None,
    precision: Optional[str] = typer.Option(None, help="precision of the linear solves: f32, f64 or auto (f32 for thick "
                                                       "films); the state and its residual are always double"),
    as_json: usual.AsJson = False, quiet: usual.Quiet = False, curves: usual.Curves = True, timing: usual.Timing = False,
):
    """Run one contact: steady start, passage of the feature, stresses, fatigue; write all results to a store.

    Numbers may have a unit. Examples: `tehl run --srr -0.12` · `tehl run dent --grid coarse --load 900N/mm` ·
    `tehl run my.toml --set feature.height=1um`
    """
    from tehl_taichi.runs import single_run, zoom_store
    from tehl_taichi.store.load_scene import find_changed

    changes = changes_of(
        {"srr": srr, "load": load, "hertz_pressure": hertz_pressure, "speed": speed, "temperature": temperature,
         "oil.name": oil, "height": height, "width": width, "kappa": kappa, "endurance": endurance, "time.steps": steps,
         "thermal.on": thermal,
         "bending_limit": bending_limit, "torsion_limit": torsion_limit,
         "fatigue.on": fatigue, "zoom.factor": None if zoom == AUTO else zoom, "time.run_in": run_in,
         "numerics.estimate_error": estimate_error, "numerics.precision": precision, "time.steady_only": steady or None},
        grid, set_ or [])
    description = find_changed(scene, changes)
    check_rows(grid, changes, lambda: description)
    description = _on_grid_for(target_error, changes, description)
    if zoom == AUTO:
        description = _before_window(context, changes, description)
    if out is None:
        say_idle(context, "without --out every run makes a store of its own", "force")
    if dry_run:
        single_run.check(description, out, force, threads, arch)
        return _print_plan(description) if as_json else _print_scene(description)
    with Live(quiet, curves) as live, time_budget(live if timing else None) as budget:
        compute = zoom_store.run if zoom == AUTO else tehl.run
        done = compute(description, out, force=force, threads=threads, arch=arch, progress=live)
    _print(done, as_json, description.warnings(), budget)
    if description.time.steps == 0 and not quiet:
        _print_time(done)


def _print_plan(description):
    from tehl_taichi.runs.summary.summary import planned_summary

    print_json(planned_summary(description))


def resume(
    store: Path = typer.Argument(..., help="store of an interrupted run, or of a run stopped with `--steps`"),
    steps: Optional[int] = typer.Option(None, min=1, help="number of further steps (default: to the end of the run; for a "
                                                          "finished run to the end of the passage)"),
    threads: usual.Threads = None,
    as_json: usual.AsJson = False, quiet: usual.Quiet = False, curves: usual.Curves = True, timing: usual.Timing = False,
):
    """Resume an interrupted run, or extend a run stopped with `--steps`.

    The run resumes from a checkpoint at most 2 s old. Coarse-grid runs, stresses and the fatigue search start again.

    Example: `tehl resume runs/gear-1.zarr`
    """
    from tehl_taichi.engine import runtime
    from tehl_taichi.runs.open_results import open_run

    before = open_run(store)
    runtime.check_number(threads)
    if before.rest(steps) is None and not before.store.seeks_window:
        entries = number_of(len(before.store), "entry", "entries")
        say(f"{store} is finished ({entries}); `tehl show {typed(store)}` prints its summary")
        if as_json:
            print_json(before.summary)
        return
    with Live(quiet, curves) as live, time_budget(live if timing else None) as budget:
        done = tehl.resume(store, steps=steps, threads=threads, progress=live)
    _print(done, as_json, budget=budget)


def zoom(
    store: Path = typer.Argument(..., help="store of a finished run with a passage"),
    factor: Any = typer.Option("4", parser=whole_or_auto, metavar="0|2|4|8|16|auto",
                               help="cells of the window in a cell of the grid: 2, 4, 8 or 16; 0 removes the window; auto: no "
                                    "window if the grid suffices, otherwise the first factor that does"),
    threads: usual.Threads = None,
    as_json: usual.AsJson = False, quiet: usual.Quiet = False, timing: usual.Timing = False,
):
    """Add a fine window that moves with the feature to a finished run; the steps of the run are kept.

    Stresses, fatigue and error bars are computed again with the window.

    Example: `tehl zoom runs/gear-1.zarr --factor 4`
    """
    with Live(quiet, False) as live, time_budget(live if timing else None) as budget:
        done = tehl.zoom(store, factor, threads=threads, progress=live)
    _print(done, as_json, budget=budget)


def _print(run, as_json, printed=(), budget=None):
    """Print the summary of a run; printed: warnings that were printed before the run; budget: its TimeBudget or None."""
    timing = {"timing_s": dict(budget.spent)} if budget else {}
    print_json({**run.summary, **timing}) if as_json else summary_table(run.summary, printed)
    if budget and not as_json:
        print_budget(budget)


def _print_scene(scene):
    """Print the plan of a run: contact, film by formula, grid, steps, features, parts left out, warnings."""
    from tehl_taichi.scene.film_formula import central_film, formula_words
    from tehl_taichi.scene.scales import Scales
    from tehl_taichi.scene.scene_warnings import preview
    from tehl_taichi.scene.timeline import total_steps

    put(f"{scene.name}: {Scales.of(scene).words}")
    put(f"h_c by formula: {central_film(scene) * 1e6:.4f} um ({formula_words(scene)})")
    a, b = (f"E = {body.E / 1e9:g} GPa, nu = {body.nu:g}" for body in (scene.body_a, scene.body_b))
    put(f"bodies: {f'both {a}' if a == b else f'a {a}; b {b}'}; oil {scene.oil.name} at {scene.operation.temperature:g} deg C")
    put(f"{scene.grid.nx} x {scene.rows} cells, {number_of(total_steps(scene), 'step')}")
    for line in (*preview(scene), *(f"left out: {one}" for one in scene.left_out()), *(f"warning: {one}" for one in
                                                                                     scene.warnings())):
        put(line)


def _print_time(done):
    """Print the estimated time of the passage after a run with `--steps 0`."""
    from tehl_taichi.runs import time_estimate

    for sentence in time_estimate.lines(done, GRIDS["coarse"]):
        say(sentence)


def _before_window(context, changes, description):
    """Scene without the window that `--zoom auto` chooses after the run; zoom.factor contradicts it: SceneError."""
    from tehl_taichi.scene import idle_keys, zoom_room

    if "zoom.factor" in changes:
        raise SceneError(f"--zoom auto and zoom.factor = {changes['zoom.factor']} contradict each other: give one of them")
    if why := zoom_room.why_none(description):
        if description.transient and not zoom_room.why_none(description.replace(**{"time.steps": -1})):
            say(f"--zoom auto waits for more steps: {why}")
        else:
            say_idle(context, why, "zoom")
        return description
    given = {key for key in idle_keys.user_keys(description) if not key.startswith("zoom.")}
    return description.replace(**{"zoom.factor": 0}).with_user_keys(given)


def _on_grid_for(target, changes, description):
    """Scene on the grid that a target error needs."""
    if target is None:
        return description
    from tehl_taichi.scene.grid_for_error import reaching

    if {"grid.nx", "grid.ny"} & changes.keys():
        raise SceneError(f"--target-error {target} chooses the grid; omit --grid")
    found = reaching(description, _share(target))
    g = found.grid
    say(f"{g.nx} x {g.ny} cells from x_min = {g.x_min:g} a, for an error of {target}")
    return found


def _share(text):
    try:
        value = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    except ValueError:
        value = -1.0
    if not 1e-4 <= value <= 0.5:
        raise SceneError(f"--target-error {text!r} must be a relative error from 0.01% to 50%, as in 1% or 0.01")
    return value
