"""`tehl run` and `tehl resume`."""

import contextlib
import json
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
                                                  help="error of the passage's numbers, by companion runs (default: where "
                                                       "a core is free for them)"),
    kappa: Optional[float] = typer.Option(None, help="Findley's kappa_F"),
    endurance: Optional[float] = typer.Option(None, help="Findley's endurance limit sigma_eF, Pa"),
    steps: Optional[int] = typer.Option(None, help="stop after this many time steps (0: the steady start alone); `tehl "
                                        "resume` goes on"),
    out: Optional[Path] = typer.Option(None, help="store to write (default: runs/SCENE-N.zarr)"),
    force: bool = typer.Option(False, "--force", help="replace an existing store, as soon as the new one has its first entry"),
    arch: str = typer.Option("cpu", help="cpu"),
    threads: Optional[int] = typer.Option(None, help="CPU threads (default: all)"),
    precision: Optional[str] = typer.Option(None, help="of the linear solves: f32, f64 or auto (f32 for thick films); the "
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

    changes = _changes(
        {"srr": srr, "load": load, "hertz_pressure": hertz_pressure, "speed": speed, "temperature": temperature,
         "height": height, "width": width, "kappa": kappa, "endurance": endurance, "time.steps": steps, "thermal.on": thermal,
         "fatigue.on": fatigue, "numerics.estimate_error": estimate_error, "numerics.precision": precision,
          "time.steady_only": steady or None},
        grid, set_ or [])
    description = find(scene)
    description = description.replace(**changes) if changes else description
    description = _on_grid_for(target_error, changes, description)
    _check_threads(threads)
    place = Place(out, force) if out else Place.fresh(Path("runs"), description.name)
    with place, _interruptible(place.path, place):
        _start(arch, threads)
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
        steady = {name: saved.needed(name) for name in ("steady_error", "steady_unknown")}
        _start("cpu", threads)
        state = saved.go_back()
        if rest and rest != saved.scene:
            saved.extend(rest)
        _go(saved, state, started, as_json, quiet, steady)


def _start(arch, threads):
    from tehl_taichi.engine import runtime

    return runtime.start(arch, threads)


def _simulate(description, place, started, as_json, quiet):
    from tehl_taichi.io.json_values import plain
    from tehl_taichi.io.provenance import provenance
    from tehl_taichi.io.store import Store
    from tehl_taichi.march.passage import march
    from tehl_taichi.scene.judge import preview
    from tehl_taichi.scene.route import most_steps

    for line in description.left_out():
        if not quiet:
            say(f"left out: {line}")
    for line in preview(description):
        if not quiet:
            say(line)
    for sentence in description.warnings():
        say(f"warning: {sentence}")
    first = next(march(description))
    steady = {"steady_error": plain(first.error), "steady_unknown": first.unknown}
    attrs = {"warnings": json.dumps(description.warnings()), **{name: json.dumps(value) for name, value in steady.items()},
             **provenance(description)}
    with Store.create(place, description, first, most_steps(description) + 1, attrs) as saved:
        _go(saved, saved.go_back(), started, as_json, quiet, steady)


def _go(saved, state, started, as_json, quiet, steady):
    from tehl_taichi.engine.launches import binding_seconds
    from tehl_taichi.io.summary import summarise
    from tehl_taichi.march import companions
    from tehl_taichi.march.passage import total_steps

    with companions.beside(saved.scene, total_steps(saved.scene) + 1 - saved.steps) as others:
        _march(saved, state, quiet)
        fatigue, maps = _fatigue(saved, quiet)
        passage = others.errors(saved, fatigue, time.perf_counter() - started)
    extra = {"wall_s": time.perf_counter() - started, "compile_s": binding_seconds(), **steady, **passage}
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
    from tehl_taichi.march.passage import total_steps

    with Live(total_steps(saved.scene), saved.last_step, quiet) as live:
        go_on(saved, state, live.step)


def _fatigue(saved, quiet):
    if not saved.scene.fatigue_wanted or saved.steps < 3:
        return None, None
    from tehl_taichi.fatigue import assessment

    if not quiet:
        say("stresses and Findley search")
    result = assessment.run(saved.scene, saved)
    return result.summary, result.maps


# options by another name than their key
WORDS = {("thermal.on", True): "--thermal", ("thermal.on", False): "--isothermal", ("time.steady_only", True): "--steady",
         ("fatigue.on", True): "--fatigue", ("fatigue.on", False): "--no-fatigue",
         ("numerics.estimate_error", True): "--estimate-error", ("numerics.estimate_error", False): "--no-estimate-error"}


def _changes(options, grid, settings):
    """{full key: value} of the options that were used and of --set; SceneError where two of them contradict each other."""
    from tehl_taichi.scene.given import settled

    used = [(key, value) for key, value in options.items() if value is not None]
    given = [(_typed(key, value), key, value) for key, value in used]
    given += [(f"--grid {grid}", key, value) for key, value in _grid(grid).items()]
    return settled([*given, *_settings(settings)])


def _typed(key, value):
    """An option as it was typed."""
    shown = value if isinstance(value, str) else f"{value:g}"
    return WORDS.get((key, value), f"--{key.rpartition('.')[2].replace('_', '-')} {shown}")


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


def _on_grid_for(target, changes, description):
    """The scene on the grid that a target error needs."""
    if target is None:
        return description
    from tehl_taichi.scene import SceneError
    from tehl_taichi.scene.target import grid_for

    if {"grid.nx", "grid.ny"} & changes.keys():
        raise SceneError(f"--target-error {target} chooses the grid; leave out --grid")
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
    """(words, key, value) of every --set."""
    from tehl_taichi.scene import SceneError

    out = []
    for pair in pairs:
        key, equals, text = pair.partition("=")
        if not equals:
            raise SceneError(f"--set {pair!r} must look like dotted.key=value, as in feature.height=1e-6")
        out.append((f"--set {pair}", key.strip(), _value(text)))
    return out


def _value(text):
    """The value of a --set, as TOML reads it; what is no TOML value is text."""
    import tomllib

    try:
        return tomllib.loads(f"v = {text}")["v"]
    except (ValueError, RecursionError):
        return text


def _check_threads(threads):
    from tehl_taichi.scene import SceneError

    if threads is not None and not 1 <= threads <= 1024:
        raise SceneError(f"--threads {threads} is out of range; allowed: 1 to 1024")




def _print(summary):
    from tehl_cli.listing import summary_table

    summary_table(summary)
