"""`tehl sweep`: many runs of one scene."""

from pathlib import Path
from typing import List, Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.live_display import say
from tehl_cli.scene_options import changes_of, check_rows
from tehl_cli.stdout import print_json, put

from tehl_taichi.errors import SceneError
from tehl_taichi.values.digits import number_of

MANY = 1000  # more cases than this need --yes


def sweep(
    scene: str = typer.Argument(..., help="built-in name, TOML scene, TOML study file, or study to resume"),
    over: Optional[List[str]] = typer.Option(None, "--over", help="key=values with values a,b,c or low:high:N or "
                                                                  "low:high:N:log; 'key=values key=values' change together; "
                                                                  "repeatable"),
    samples: Optional[int] = typer.Option(None, help="number of cases of a Latin hypercube, with --over key=low:high[:log] or "
                                                     "a,b,c"),
    seed: Optional[int] = typer.Option(None, help="seed of the samples (default: 0)"),
    set_: usual.SetInAll = None, grid: usual.Grid = None,
    steady: bool = typer.Option(False, "--steady", help="compute steady contacts only"),
    thermal: usual.Thermal = None, fatigue: usual.Fatigue = None,
    steps: Optional[int] = typer.Option(None, help="stop every case after this many time steps"),
    workers: usual.Workers = None, threads_per_worker: usual.ThreadsPerWorker = None,
    scheduler: Optional[str] = typer.Option(None, help="address of a running Dask scheduler, for example tcp://10.0.0.1:8786"),
    keep: str = typer.Option("stores", help="stores (table and one store per case) or summary (table only)"),
    out: Optional[Path] = typer.Option(None, help="study to write or resume (default: runs/NAME.zarr, which depends on the "
                                                  "sweep only)"),
    yes: bool = typer.Option(False, "--yes", help=f"allow more than {MANY} cases"),
    dry_run: usual.DryRun = False,
    as_json: usual.AsJson = False, quiet: usual.Quiet = False,
):
    """Run all combinations of scene values and collect the results in one table. Repeat the command to resume.

    Examples: `tehl sweep gear --over srr=-0.3:0.3:7 --over feature.height=0.5e-6,1e-6` · `tehl sweep study.toml` ·
    `tehl sweep gear --samples 40 --over srr=-0.3:0.3 --over speed=1:20:log` · then `tehl plot runs/NAME.zarr`
    """
    from tehl_cli.sweep_display import SweepLive, doubts

    from tehl_taichi.runs.sweep import sweeping

    options = {"time.steps": steps, "thermal.on": thermal, "fatigue.on": fatigue, "time.steady_only": steady or None}
    changes = changes_of(options, grid, set_ or [])
    plan, out = _planned(scene, over or [], samples, seed, changes, grid, out)
    out = out or sweeping.default_path(plan)
    if dry_run:
        sweeping.check_settings(workers, threads_per_worker, scheduler, keep, connect=False)
        sweeping.check_place(plan, out, keep)
        return print_json(_planned_dict(plan, out)) if as_json else _report(plan, out)
    _check_count(plan, yes)
    for sentence in (*doubts(plan), *plan.warnings()):
        say(f"warning: {sentence}")
    with SweepLive(quiet) as live:
        study = sweeping.run(plan, out, workers=workers, threads_per_worker=threads_per_worker, scheduler=scheduler, keep=keep,
                             progress=live, say_line=say)
    _print(study, as_json)
    raise typer.Exit(0 if study.counts["converged"] == len(study) else 3)


def _planned(name, over, samples, seed, changes, grid, out):
    """(plan, path of its study or None) from a scene with --over, a study file, or a study."""
    from tehl_taichi.runs.sweep import study_file
    from tehl_taichi.runs.sweep.axis_syntax import over_of
    from tehl_taichi.runs.sweep.plan import plan
    from tehl_taichi.runs.sweep.study_table import Study, is_study
    from tehl_taichi.scene.aliases import check_swept
    from tehl_taichi.store.load_scene import find_changed

    whole = study_file.is_study_file(name) or is_study(name)
    if whole and (over or changes or samples is not None or seed is not None):
        raise SceneError(f"{name} already defines the sweep; omit --over, --samples, --set and scene options")
    if whole:
        return (study_file.load(name), out) if study_file.is_study_file(name) else (Study.open(name).plan, out or Path(name))
    swept = over_of(over, samples is not None)
    check_swept(changes, [key for keys in swept for key in ((keys,) if isinstance(keys, str) else keys)])
    scene = find_changed(name, changes)
    check_rows(grid, changes, lambda: scene)
    return plan(scene, swept, samples, seed), out


def _check_count(plan, yes):
    if plan.count > MANY and not yes:
        raise SceneError(f"{plan.count} cases are more than {MANY}; use --yes to run them anyway, --dry-run to list them")


def _planned_dict(plan, out):
    """JSON object of a sweep that would run; results: all cases, with the reason of a refused one."""
    from tehl_cli.sweep_display import doubts

    refused = plan.refused()
    return {"dry_run": True, "scene": plan.scene.name, "cases": plan.count, "shape": plan.shape, "study": str(out),
            "warnings": [*doubts(plan), *plan.warnings()],
            "results": [{"case": n, "changes": plan.changes(n), "reason": refused.get(n, "")} for n in range(plan.count)]}


def _report(plan, out):
    """Print the plan of a sweep."""
    from tehl_cli.sweep_display import doubts

    from tehl_taichi.runs.sweep.axis_syntax import short_word
    from tehl_taichi.runs.sweep.study_labels import key_unit
    from tehl_taichi.scene.scales import Scales

    refused = plan.refused()
    shape = f" ({' x '.join(map(str, plan.shape))})" if len(plan.shape) > 1 else ""
    put(f"{number_of(plan.count, 'case')}{shape} of {plan.scene.name} into {out}")
    put(f"{plan.scene.name}: {Scales.of(plan.scene).words}")
    for key in plan.keys:
        values = [short_word(value) for value in plan.coordinate(key)[1]]
        put(f"{key} = {', '.join(values[:12])}{' ...' if len(values) > 12 else ''} {key_unit(plan.scene, key)}".rstrip())
    for number, reason in refused.items():
        put(f"case {number} would be refused: {reason}")
    for sentence in (*doubts(plan), *plan.warnings()):
        put(f"warning: {sentence}")


def _print(study, as_json):
    from tehl_cli.sweep_display import print_study

    print_json(study.to_dict()) if as_json else print_study(study)
