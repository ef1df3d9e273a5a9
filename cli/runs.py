"""`tehl run` and `tehl resume`."""

import contextlib
import json
import sys
import time
from pathlib import Path
from typing import List, Optional

import typer
from tehl_cli.live import Live, say
from tehl_cli.out import print_json

from tehl_taichi.errors import Interrupted

GRIDS = {"coarse": (128, 32), "medium": (256, 64), "fine": (512, 128)}


def register(app):
    """Add the commands to the app."""
    app.command()(run)
    app.command()(resume)


def run(
    scene: str = typer.Argument("gear", help="built-in name (see `tehl scenes`), TOML file, or a store to repeat"),
    srr: Optional[float] = typer.Option(None, help="slip over mean speed, (u_a - u_b)/u_m; negative: dedendum"),
    load: Optional[float] = typer.Option(None, help="N/m (line) or N (point)"),
    hertz_pressure: Optional[float] = typer.Option(None, help="Pa, instead of a load"),
    speed: Optional[float] = typer.Option(None, help="mean speed u_m, m/s"),
    temperature: Optional[float] = typer.Option(None, help="inlet temperature, deg C"),
    height: Optional[float] = typer.Option(None, help="feature height, m (negative: dent)"),
    width: Optional[float] = typer.Option(None, help="feature width, m"),
    set_: Optional[List[str]] = typer.Option(None, "--set", help="dotted.key=value, repeatable"),
    grid: Optional[str] = typer.Option(None, help="coarse, medium, fine or NXxNY (cells or nodes)"),
    target_error: Optional[str] = typer.Option(None, help="the grid for this error, as in 1% (see `tehl bench accuracy`)"),
    steady: bool = typer.Option(False, "--steady", help="no march in time"),
    thermal: Optional[bool] = typer.Option(None, "--thermal/--isothermal", help="energy equation on or off"),
    fatigue: Optional[bool] = typer.Option(None, "--fatigue/--no-fatigue", help="stresses and Findley index"),
    estimate_error: Optional[bool] = typer.Option(None, "--estimate-error/--no-estimate-error",
                                                  help="error of the passage's numbers, by companion runs"),
    kappa: Optional[float] = typer.Option(None, help="Findley's kappa_F"),
    endurance: Optional[float] = typer.Option(None, help="Findley's endurance limit sigma_eF, Pa"),
    steps: Optional[int] = typer.Option(None, help="stop after this many time steps (0: the steady start alone); `tehl "
                                        "resume` goes on"),
    out: Optional[Path] = typer.Option(None, help="store to write (default: runs/SCENE-N.zarr)"),
    force: bool = typer.Option(False, "--force", help="replace an existing store, as soon as the new one has its first entry"),
    arch: str = typer.Option("cpu", help="cpu"),
    threads: Optional[int] = typer.Option(None, help="CPU threads (default: all)"),
    precision: Optional[str] = typer.Option(None, help="of the linear solves: f32 or f64 (default: f32 for thick films); the "
                                            "state and its residual are always double"),
    as_json: bool = typer.Option(False, "--json", help="one JSON object on stdout, everything else on stderr"),
    quiet: bool = typer.Option(False, "--quiet", help="no progress"),
):
    """Steady start, the feature passes, stresses, fatigue; streamed to a store.

    Examples: `tehl run --srr -0.12` · `tehl run dent --grid coarse` · `tehl run my.toml --set feature.height=1e-6`
    """
    started = time.perf_counter()
    from tehl_taichi.io.found import find
    from tehl_taichi.io.place import Place
    from tehl_taichi.precision import suited

    changes = {"srr": srr, "load": load, "hertz_pressure": hertz_pressure, "speed": speed, "temperature": temperature,
               "height": height, "width": width, "kappa": kappa, "endurance": endurance, "thermal.on": thermal,
               "fatigue.on": fatigue, "numerics.estimate_error": estimate_error,
               "time.steps": steps, "time.steady_only": True if steady else None}
    changes = {key: value for key, value in changes.items() if value is not None}
    changes.update(_grid(grid))
    changes.update(_settings(set_ or []))
    description = find(scene)
    description = description.replace(**changes) if changes else description
    description = _on_grid_for(target_error, grid, description)
    _check_threads(threads)
    place = Place(out, force) if out else Place.fresh(Path("runs"), description.name)
    with place, _interruptible(place.path, place):
        _start(arch, threads, precision or suited(description))
        _simulate(description, place, started, as_json, quiet)


def resume(
    store: Path = typer.Argument(..., help="store of an interrupted run, or of a passage that was cut"),
    steps: Optional[int] = typer.Option(None, min=1, help="so many more (default: to the end that the run was given; of a "
                                        "finished run, to the end of its passage)"),
    threads: Optional[int] = typer.Option(None, help="CPU threads (default: all)"),
    as_json: bool = typer.Option(False, "--json", help="one JSON object on stdout"),
    quiet: bool = typer.Option(False, "--quiet", help="no progress"),
):
    """Go on, at most two seconds of work before the last stored step; a finished run to the end of its passage.

    Example: `tehl resume runs/gear-1.zarr`
    """
    started = time.perf_counter()
    from tehl_taichi.io.store import Store
    from tehl_taichi.scene.route import continued

    saved = Store.open(store)
    rest = continued(saved.scene, saved.last_step, steps) if saved.finished or steps else saved.scene
    if saved.finished and rest is None:
        say(f"{store} is finished ({saved.steps} entries); `tehl show {store}` prints its summary")
        if as_json:
            print_json(saved.summary)
        return
    _check_threads(threads)
    with _interruptible(store), Store.write(store) as saved:
        steady_error, precision = saved.needed("steady_error"), saved.precision
        _start("cpu", threads, precision)
        state = saved.go_back()
        if rest and rest != saved.scene:
            saved.extend(rest)
        _go(saved, state, started, as_json, quiet, steady_error)


def _start(arch, threads, precision):
    from tehl_taichi import runtime

    return runtime.start(arch, threads, precision)


def _simulate(description, place, started, as_json, quiet):
    from tehl_taichi.io.plain import plain
    from tehl_taichi.io.store import Store
    from tehl_taichi.scene.route import most_steps
    from tehl_taichi.simulation import march

    for line in description.left_out():
        if not quiet:
            say(f"left out: {line}")
    for sentence in description.warnings():
        say(f"warning: {sentence}")
    first = next(march(description))
    attrs = {"command": " ".join(sys.argv), "steady_error": json.dumps(plain(first.error)),
             "warnings": json.dumps(description.warnings()), **_machine()}
    with Store.create(place, description, first, most_steps(description) + 1, attrs) as saved:
        _go(saved, saved.go_back(), started, as_json, quiet, first.error)


def _go(saved, state, started, as_json, quiet, steady_error):
    from tehl_taichi.io.summary import summarise
    from tehl_taichi.launches import binding_seconds

    _march(saved, state, quiet)
    fatigue, maps = _fatigue(saved, quiet)
    error = _passage_error(saved, fatigue, quiet)
    extra = {"wall_s": time.perf_counter() - started, "compile_s": binding_seconds(), "steady_error": steady_error,
             "passage_error": error}
    summary = summarise(saved, extra, fatigue)
    saved.finish(summary, maps)
    print_json(summary) if as_json else _print(summary)


@contextlib.contextmanager
def _interruptible(path, place=None):
    """Ctrl-C anywhere inside ends in a sentence that says what is stored at `path`, and exit code 4."""
    try:
        yield
    except KeyboardInterrupt:
        if place and not place.published:
            raise Interrupted("interrupted before anything was stored") from None
        raise Interrupted(_what_is_left(path)) from None


def _what_is_left(path):
    from tehl_taichi.errors import StoreError
    from tehl_taichi.io.store import Store

    try:
        saved = Store.open(path)
    except StoreError:
        return f"interrupted; {path} cannot be read any more"
    if saved.finished:
        return f"interrupted; {path} is finished"
    return f"interrupted after {saved.last_step} steps; go on with: tehl resume {path}"


def _march(saved, state, quiet):
    from tehl_taichi.io.recorder import go_on
    from tehl_taichi.simulation import total_steps

    with Live(total_steps(saved.scene), saved.last_step, quiet) as live:
        go_on(saved, state, live.step)


def _fatigue(saved, quiet):
    if not saved.scene.fatigue_wanted or saved.steps < 3:
        return None, None
    from tehl_taichi.post import fatigue

    if not quiet:
        say("stresses and Findley search")
    result = fatigue.run(saved.scene, saved)
    return result.summary, result.maps


def _passage_error(saved, fatigue, quiet):
    if not saved.scene.numerics.estimate_error or saved.steps < 2:
        return None
    from tehl_taichi.io.summary import passage_values
    from tehl_taichi.post import estimate

    return estimate.errors(saved.scene, passage_values(saved, fatigue), None if quiet else say)


def _grid(text):
    if text is None:
        return {}
    from tehl_taichi.scene import SceneError

    if text in GRIDS:
        nx, ny = GRIDS[text]
    else:
        try:
            nx, ny = (int(part) // 2 * 2 for part in text.lower().split("x"))
        except ValueError:
            raise SceneError(f"--grid {text!r} is not known; allowed: {', '.join(GRIDS)} or NXxNY, as in 256x64") from None
    return {"grid.nx": nx, "grid.ny": ny}


def _on_grid_for(target, grid, description):
    """The scene on the grid that a target error needs."""
    if target is None:
        return description
    from tehl_taichi.profiles.target import grid_for

    from tehl_taichi.scene import SceneError

    if grid is not None:
        raise SceneError(f"--target-error {target} chooses the grid; leave out --grid {grid}")
    nx, ny = grid_for(description, _share(target))
    say(f"{nx} x {ny} cells for an error of {target}")
    return description.replace(**{"grid.nx": nx, "grid.ny": ny})


def _share(text):
    from tehl_taichi.scene import SceneError

    try:
        value = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    except ValueError:
        value = -1.0
    if not 1e-4 <= value <= 0.5:
        raise SceneError(f"--target-error {text!r} must be a relative error from 0.01% to 50%, as in 1% or 0.01")
    return value


def _settings(pairs):
    import tomllib

    from tehl_taichi.scene import SceneError

    out = {}
    for pair in pairs:
        key, equals, text = pair.partition("=")
        if not equals:
            raise SceneError(f"--set {pair!r} must look like dotted.key=value, as in feature.height=1e-6")
        try:
            out[key.strip()] = tomllib.loads(f"v = {text}")["v"]
        except tomllib.TOMLDecodeError:
            out[key.strip()] = text
    return out


def _check_threads(threads):
    from tehl_taichi.scene import SceneError

    if threads is not None and not 1 <= threads <= 1024:
        raise SceneError(f"--threads {threads} is out of range; allowed: 1 to 1024")


def _machine():
    import platform

    from tehl_taichi import __version__, runtime

    return {"version": __version__, "machine": platform.platform(), "python": platform.python_version(),
            "runtime": json.dumps(runtime.ensure())}


def _print(summary):
    from tehl_cli.tables import summary_table

    summary_table(summary)
