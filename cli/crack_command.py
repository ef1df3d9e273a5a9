"""tehl crack: crack paths under the loads of a stored passage."""

from pathlib import Path
from typing import Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.amount import number
from tehl_cli.idle_options import say_no_figure
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json, put
from tehl_cli.tables import list_table


def crack(
    store: Path = typer.Argument(..., help="store of a run with a feature on y = 0, finished or not"),
    context: typer.Context = None,
    surface: str = typer.Option("worse", help="body with the cracks: a, b or worse (the body that decides the verdict)"),
    side: str = typer.Option("both", help="side of the feature: entry, exit or both"),
    start: Optional[float] = number("x' of the crack mouth, m (default: place of the largest surface tension); on the body "
                                    "without the feature, measured from the place opposite the feature at X = 0"),
    angle: float = number("angle of the first segment, degrees; 90 is straight down, larger "
                          "angles lean in the rolling direction", 90.0),
    first: float = number("length of the first segment, m", 5e-6),
    step: float = number("length of the other segments, m", 5e-6),
    length: float = number("length at which the crack stops, m", 100e-6),
    distance: float = number("distance ahead of the tip, m, at which the largest tension sets the direction", 3e-6),
    threshold: Optional[float] = number("threshold of K_I, Pa sqrt(m); the crack stops below it (default: none)"),
    residual: Optional[str] = typer.Option(None, help="residual stress along x, Pa, or a CSV file with depth and stress "
                                                      "(m, Pa or the units in the names of its columns)"),
    face_friction: float = typer.Option(0.0, help="friction coefficient of the closed crack faces"),
    oil: str = typer.Option("dry", help="oil in the crack: dry, film (film pressure above the mouth, an upper bound; a number "
                                        "such as 0.3: this share of it), sealed (trapped when the mouth closes) or flow "
                                        "(flow along the crack)"),
    thermal_stress: Optional[bool] = typer.Option(None, "--thermal-stress/--no-thermal-stress",
                                                  help="include thermal stress (default: as in the run)"),
    elements: int = typer.Option(12, help="number of elements of a straight crack, 6 to 200"),
    keep: bool = typer.Option(False, "--keep", help="save the result beside the store, for `tehl report`"),
    figures: usual.Figures = None,
    format: usual.Format = "png", dpi: usual.Dpi = 160, width: usual.Width = 17.0, force: usual.Force = False,
    threads: usual.Threads = None, as_json: usual.AsJson = False,
):
    """Compute crack paths in one body from both sides of the feature, in the plane y = 0. The store does not change.

    Example: `tehl crack runs/gear-1.zarr --residual -100e6 --figures runs/crack`
    """
    from tehl_taichi.crack.residual_stress import read
    from tehl_taichi.runs.open_results import open_run
    from tehl_taichi.store import crack_file
    from tehl_taichi.view.figures.figure_style import FigureStyle

    page = FigureStyle(format, dpi, width, force)
    page.check_all(figures, ["crack"]) if figures else say_no_figure(context, "it needs --figures")
    run = open_run(store)
    if keep:
        crack_file.check(store)
    result = run.crack(surface=surface, side=side, start=start, angle=angle, first=first, step=step, length=length,
                       distance=distance, threshold=threshold, residual=None if residual is None else read(residual),
                       face_friction=face_friction, oil=_share(oil), elements=elements, thermal_stress=thermal_stress,
                       threads=threads)
    _show(result.summary, as_json)
    if keep:
        say(str(crack_file.save(result, run.store)))
    if figures:
        from tehl_taichi.view.figures.crack_figures import write_crack

        say(str(write_crack(result, run.scene.name, figures, page)))


def _share(oil):
    """A number as a float, other texts as the name of a filling."""
    try:
        return float(oil)
    except ValueError:
        return oil


def _show(summary, as_json):
    if as_json:
        print_json(summary)
        return
    for side, found in summary["sides"].items():
        title = f"crack in body {summary['surface']} on the {side} side"
        list_table(title, ("quantity", "value"), _rows(found, summary["pit_angles_deg"]))
        for doubt in found.get("doubts", []):
            put(f"warning: {doubt}")


def _rows(found, pits):
    """(quantity, value) of one side."""
    from tehl_taichi.crack.analysis import SMALL

    if not found["opens"]:
        return [("no crack", found["why"])]
    rows = [("largest tension at the surface", f"{found['sigma1_surface_Pa'] / 1e6:.0f} MPa"),
            ("at x' (feature position)", f"{found['start_x_m'] * 1e6:.1f} um ({found['moment_x_m'] * 1e6:.0f} um)"),
            (f"tension above {SMALL:.0%} of its largest value down to", f"{found['tension_depth_m'] * 1e6:.1f} um")]
    for name in ("trajectory", "path"):
        rows += [(f"{name} leans", found[name]["lean"]),
                 (f"{name}: chord at 10, 20, 40 um (pits {pits[0]:g} to {pits[1]:g})", _chords(found[name]))]
    return rows + _growth(found)


def _chords(shape):
    return ", ".join("-" if chord is None else f"{chord:.0f}" for chord in shape["chord_deg_at_um"].values()) + " deg"


def _growth(found):
    """Rows of K_I and K_II over the crack length."""
    rows = [(f"K_I up to, range of K_II at {step['length_m'] * 1e6:.1f} um",
             f"{step['K_I_max'] / 1e6:.3f}, {step['K_II_range'] / 1e6:.2f} MPa sqrt(m)") for step in _some_steps(found["K"])]
    error = found.get("error_at_last_length")
    if error:
        rows.append(("their errors at the last length", f"{error['K_I_max'] / 1e6:.1g}, {error['K_II_range'] / 1e6:.1g}"))
    return rows + [("stop reason", found["why"])]


def _some_steps(steps):
    """The first, the last and a few steps between."""
    return [steps[n] for n in sorted({0, *range(0, len(steps), max(len(steps) // 4, 1)), len(steps) - 1})] if steps else []
