"""Commands that list and show: scenes, oils, steels, laws, new, show, plot, doctor."""

from pathlib import Path
from typing import Any, Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.amount import metres, number
from tehl_cli.bearing_command import print_bearing
from tehl_cli.cam_command import print_cam
from tehl_cli.flank_command import print_flank
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json, put
from tehl_cli.tables import history_table, list_table, print_wrapped, summary_table, warning_lines

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.values import plugins
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.escape import typed


def scenes():
    """List the built-in scenes and the feature shapes."""
    from tehl_taichi.scene import BUILT_INS
    from tehl_taichi.scene.feature import SHAPES, USED_BY

    list_table("built-in scenes (tehl run NAME)", ("name", "what"), [(name, text) for name, (_, text) in BUILT_INS.items()])
    list_table("shapes of features (--set feature.shape=NAME)", ("name", "what", "keys", "source"),
               [(shape.name, shape.says, ", ".join(key for key, users in USED_BY.items() if shape.name in users), shape.source)
                for shape in SHAPES.values()])


def oils():
    """List the named oils with viscosity at p = 0, pressure-viscosity coefficient and source."""
    from tehl_taichi.scene.named_oils import NAMED

    list_table("named oils; at p = 0: eta in mPa s at 40 and 100 C, alpha in 1/GPa at 40 C",
               ("name", "what", "eta 40", "eta 100", "alpha"),
               [(name, oil.says, *oil.shown_numbers) for name, oil in NAMED.items()])
    for name, oil in NAMED.items():
        print_wrapped(f"{name}: {oil.source} [{oil.oil.viscosity}]")
    print_wrapped("To choose one: --oil NAME. For your own oil give its data sheet (m2/s, kg/m3): --set oil.nu_40=220e-6 "
                  "--set oil.nu_100=19e-6 --set oil.rho_15=890")


def steels():
    """List the named steels with their numbers and sources."""
    from tehl_taichi.scene.named_steels import STEELS

    rows = [(name, f"{n['E'] / 1e9:g}", f"{n['nu']:g}", f"{n['k']:g}", f"{n['rho']:g}", f"{n['c']:g}", f"{n['alpha']:.4g}")
            for name, steel in STEELS.items() for n in (steel.numbers,)]
    list_table("named steels (--set bodies.a.material=NAME)",
               ("name", "E GPa", "nu", "k W/mK", "kg/m3", "J/kgK", "alpha 1/K"), rows)
    for name, steel in STEELS.items():
        print_wrapped(f"{name}: {steel.says}; {steel.source}")


def laws():
    """List the laws of oil and friction, the fatigue criteria and relations to hardness, with their constants and sources."""
    from tehl_taichi.laws.choices import ALONE, CHOICES
    from tehl_taichi.laws.hardening import HARDENINGS

    for key, registry in {**CHOICES, "": ALONE}.items():
        list_table(f"--set {key}=NAME" if key else "always used", ("name", "law", "numbers", "source"),
                   [(law.name, law.says, ", ".join(law.numbers), law.source) for law in registry.values()])
    list_table("--set fatigue.criterion=NAME", ("name", "criterion", "kappa: sensitivity to", "source"),
               [(rule.name, rule.says, rule.sensitivity, rule.source) for rule in CRITERIA.values()])
    list_table("--set fatigue.relation=NAME", ("name", "limit by hardness", "HV", "spread", "source"),
               [(one.name, one.says, f"{one.low:g} to {one.high:g}", one.spread, one.source) for one in RELATIONS.values()])
    list_table("--set bodies.a.hardening=NAME (run-in)", ("name", "flow stress", "source"),
               [(one.name, one.says, one.source) for one in HARDENINGS.values()])


def new(
    file: Path = typer.Argument(..., help="scene file to write, for example my.toml"),
    base: Optional[str] = typer.Option(None, help="built-in scene to start from (default: gear); with --gears: built-in pair "
                                                  "(default: fzg-c)"),
    gears: bool = typer.Option(False, "--gears", help="write a gear pair for `tehl flank` in place of a scene"),
    scan: Optional[Path] = typer.Option(None, help="file of measured heights, on a grid or along a line; writes a "
                                                   "short scene with the values that you must give"),
    unit: str = typer.Option("", help="unit of the heights: nm, um, mm or m"),
    pixel: Optional[float] = number("distance between points of a row, m"),
    pixel_y: Optional[float] = number("distance between rows, m (default: --pixel)"),
    lay: str = typer.Option("", help="line profile: direction of the marks, transverse (heights over x, the rolling direction; "
                                     "default) or longitudinal (heights over y)"),
):
    """Write a commented scene file with every value, a short one for a scan, or a gear pair.

    Examples: `tehl new my.toml` · `tehl new my_gears.toml --gears` ·
    `tehl new my_flank.toml --scan scan.csv --unit um --pixel 1.8e-6` ·
    `tehl new my_profile.toml --scan profile.txt --unit um --pixel 0.5e-6 --lay longitudinal`
    """
    from tehl_taichi.scene import gear_file, scan_scene, scene_file

    if scan is None:
        _only_with_scan(unit=unit, pixel=pixel, pixel_y=pixel_y, lay=lay)
    if gears:
        _not_of_gears(scan)
        gear_file.new(file, base or "fzg-c")
        return put(f"wrote {file}; run it with: tehl flank {typed(file)}")
    base = base or "gear"
    if scan is None:
        scene_file.new(file, base)
        return put(f"wrote {file}; run it with: tehl run {typed(file)}")
    pixel, pixel_y = (metres(option, value, 0.0) for option, value in (("--pixel", pixel), ("--pixel-y", pixel_y)))
    read, missing, refused = scan_scene.new(file, base, scan, unit, pixel, pixel_y, lay)
    fill = f"fill in feature.{' and feature.'.join(missing)} and " if missing else ""
    text = f"wrote {file} for {scan} ({read}); {fill}enter the values of your contact, oil and steel, then run: "
    put(f"{text}tehl run {typed(file)} --grid coarse --steps 0")
    if refused:
        put(f"warning: the scene is refused until you change it: {refused}")


def _not_of_gears(scan):
    if scan is not None:
        raise SceneError(f"--gears and --scan {scan} contradict each other: a gear file names a scene, which has the scan")


def _only_with_scan(**options):
    for key, value in options.items():
        if value:
            raise SceneError(f"--{key.replace('_', '-')} {value} has no effect without a scan; name its file with --scan FILE")


def show(
    store: Path = typer.Argument(..., help="store of a run (finished, running or interrupted), a study, or the folder of a "
                                            "flank, bearing or cam"),
    as_json: bool = typer.Option(False, "--json", help="print the summary as one JSON object, as `tehl run --json` does"),
):
    """Print the summary and residual history of a run, or the table of a study, flank, bearing or cam.

    Example: `tehl show runs/gear-1.zarr --json | jq .fatigue`
    """
    from tehl_taichi.runs.open_results import RUN, kind

    found: Any = tehl.open(store)
    if kind(store) != RUN:
        return _show_table(found, as_json)
    _say_lacking(found)
    _show_run(found.store, as_json)


def _say_lacking(run):
    """Warn that a law of the run is not installed here."""
    if run.store.lacks:
        say(f"warning: {run.store.lacks}")


def _show_table(found, as_json):
    from tehl_cli.sweep_display import print_study

    from tehl_taichi.runs.bearing import Bearing
    from tehl_taichi.runs.cam import Cam
    from tehl_taichi.runs.flank import Flank

    if as_json:
        return print_json(found.to_dict())
    printed = {Flank: print_flank, Bearing: print_bearing, Cam: print_cam}.get(type(found), print_study)
    printed(found)


def _show_run(saved, as_json):
    from tehl_taichi.runs.summary.summary import unfinished_summary

    if as_json:
        return print_json(saved.summary or unfinished_summary(saved))
    store = saved.path
    put(f"{store}: scene {saved.scene.name}, {number_of(saved.steps, 'entry', 'entries')}, {_state(saved)}")
    if saved.scene.note:
        put(f"note: {saved.scene.note}", "\n")
    if other := saved.other_version:
        put(f"{store} was {other}")
    if saved.summary:
        summary_table(saved.summary)
    else:
        warning_lines(saved.warnings)
    shown = sorted({*range(0, saved.steps, max(saved.steps // 20, 1)), saved.steps - 1})
    history_table(saved.scalar, shown)


def _state(saved):
    """State of a run, and the command that finishes it."""
    from tehl_taichi.runs import run_in_stage

    if saved.writer:
        return f"still being written by {saved.writer}{run_in_stage.words(saved)}"
    if not saved.finished:
        return f"not finished{run_in_stage.words(saved)}; resume with: tehl resume {typed(saved.path)}"
    if saved.seeks_window:
        return f"finished without the window that it needs; continue with: tehl resume {typed(saved.path)}"
    if saved.cut is None:
        return "finished"
    return f"finished, cut at {saved.cut:.2f} a; extend with: tehl resume {typed(saved.path)}"


def plot(store: Path = typer.Argument(..., help="store of a run, a study, or the folder of a flank, bearing or cam"),
         out: Path = typer.Option(None, help="folder for the figures (default: beside the store; for the others: inside it)"),
         quantity: str = typer.Option(None, help="study: column of its table to draw, such as judged_Fi"),
         format: usual.Format = "png", dpi: usual.Dpi = 160, width: usual.Width = 17.0, force: usual.Force = False,
         at: Optional[float] = typer.Option(None, help="run: position of the (first) feature to draw, in half-widths a "
                                                       "(default: -0.8, 0, 0.8 for curves, 0 for maps)"),
         depth: Optional[float] = number("run: depth of a second fatigue map, µm below the surface, among those searched "
                                         "(default: the critical one)"),
         interference: Optional[str] = typer.Option(None, help="run: also draw the interference colours of the film: chromatic "
                                                               "(white light) or monochromatic"),
         refractive_index: Optional[float] = typer.Option(None, help="refractive index of the oil at p = 0, for "
                                                                     "--interference (default: 1.47)"),
         wavelength: Optional[float] = number("wavelength of monochromatic light, m (default: 589.3 nm)")):
    """Draw the figures of a run, a study, a flank, a bearing or a cam.

    Run: pressure and film along the centreline, maps, fatigue. Study: results over the swept keys. Flank: results along
    the line of action. Bearing: loads of the elements, pressure and slip over both contacts. Cam: results
    over the angle.

    Examples: `tehl plot runs/gear-1.zarr --format pdf --width 8.5 --at 0.5` · `tehl plot runs/gear-1.zarr --dpi 300` ·
    `tehl plot runs/gear-sweep-0a1b2c.zarr --quantity steady_h_c_m` ·
    `tehl plot runs/ball-on-glass-1.zarr --interference chromatic`
    """
    page = dict(dpi=dpi, format=format, width=width, force=force)
    options = {"quantity": quantity, "at": at, "depth": depth, "interference": interference, "wavelength": wavelength,
               "refractive_index": refractive_index}
    for path in _draw(store, out, options, page):
        put(path)


# of tehl plot: what only such a one can show
OPTIONS = {"run": ("at", "depth", "interference", "refractive_index", "wavelength"),
           "study": ("quantity",), "flank": (), "bearing": (), "cam": ()}


def _draw(store, out, options, page):
    """Draw the figures of the results at `store`; returns their paths. options: {option: value} of OPTIONS, None if not
    given.
    """
    from tehl_taichi.runs.open_results import BEARING, CAM, FLANK, RUN, kind

    which = kind(store)
    found: Any = tehl.open(store)
    for name, value in options.items():
        if value is not None and name not in OPTIONS[which]:
            whose = next(other for other, options in OPTIONS.items() if name in options)
            raise SceneError(f"--{name} {value} applies to a {whose}, but {store} is a {which}")
    if which == RUN:
        _say_lacking(found)
    mine = {name: options[name] for name in OPTIONS[which]}
    if which in (FLANK, BEARING, CAM):
        return [found.plot(out and out / which, **page)]
    return (found.save_figures if which == RUN else found.plot)(out, **mine, **page)


def _show_plugins():
    """Print tables of the plugins and their entries; returns whether all give their known values."""
    from tehl_taichi.runs import self_test

    if named := plugins.folders():
        list_table("plugins", ("folder", "named by"), [(str(folder), who) for folder, who in named.items()], whole=True)
    found = self_test.plugins_checked()
    if found:
        list_table("entries of plugins", ("file", "name", "known value", "computed", ""),
                   [(*row, "good" if right else "WRONG") for *row, right in found])
    for path in plugins.unread_files():
        put(f"warning: {path} is not read; move it to the subfolder of its kind, as shear")
    return all(right for *_, right in found)


def doctor():
    """Print versions, threads and cache, check your plugins (TEHL_PLUGINS), and run a short self-test."""
    from tehl_taichi.runs import self_test

    list_table("this installation", ("what", "value"), self_test.installation().items())
    right = _show_plugins()
    film, good, seconds = self_test.self_test()
    say(f"self-test: steady film of smooth-line {film * 1e6:.4f} um in {seconds:.1f} s: "
        f"{'good' if good else 'WRONG, expected 0.43 um'}")
    raise typer.Exit(0 if good and right else 1)
