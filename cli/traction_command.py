"""tehl traction: friction over slip, speed and temperature."""

from pathlib import Path
from typing import Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.idle_options import say_no_figure
from tehl_cli.live_display import say
from tehl_cli.missing_results import refuse_missing
from tehl_cli.scene_options import changes_of, check_rows
from tehl_cli.stdout import print_json, put
from tehl_cli.tables import list_table, warning_lines

from tehl_taichi.values.digits import with_bar, with_error

LIST = "values a,b,c or low:high:N or low:high:N:log, units allowed:"


def traction(
    scene: str = typer.Argument(..., help="built-in name, TOML scene or store; its features are left out"),
    context: typer.Context = None,
    srr: str = typer.Option("0:0.5:11", help=f"slide-roll ratios, {LIST} 0:50%:11"),
    temperature: Optional[str] = typer.Option(None, help=f"inlet temperatures, deg C, {LIST} 40,80,120C (default: that of "
                                                                    "the scene)"),
    speed: Optional[str] = typer.Option(None, help=f"mean speeds, m/s, {LIST} 100mm/s:10m/s:9:log; with one --srr a "
                                                              "Stribeck curve"),
    oil: usual.Oil = None,
    load: Optional[str] = typer.Option(None, help=f"loads, N (line: N/m), {LIST} 20:60:3N"),
    hertz_pressure: Optional[str] = typer.Option(None, help=f"Hertz pressures instead of loads, Pa, {LIST} 0.75,1,1.25GPa"),
    thermal: usual.UsuallyThermal = None, set_: usual.SetInAll = None, grid: usual.Grid = None,
    out: Optional[Path] = typer.Option(None, help="study to write or resume (default: runs/NAME-traction-ID.zarr)"),
    figure: bool = typer.Option(True, "--figure/--no-figure", help="draw traction.png (.pdf, .svg) beside the study"),
    format: usual.Format = "png", dpi: usual.Dpi = 160, figure_width: usual.FigureWidth = 17.0,
    workers: usual.Workers = None, threads_per_worker: usual.ThreadsPerWorker = None,
    as_json: usual.AsJson = False, quiet: usual.Quiet = False,
):
    """Compute traction curves of a steady contact: friction, film and temperature over slip, for several inlet temperatures,
    loads or speeds. Repeat the command to resume.

    Examples: `tehl traction smooth-line --srr 0:0.5:11 --temperature 40,80,120` · `tehl traction mtm --srr 0.1 --speed
    0.1:10:9:log --oil mineral-vg220`
    """
    from tehl_cli.sweep_display import SweepLive, doubts

    from tehl_taichi.runs.traction.traction_run import computed, traction_plan
    from tehl_taichi.store.load_scene import find
    from tehl_taichi.view.figures.figure_style import FigureStyle, import_matplotlib

    page = FigureStyle(format, dpi, figure_width, force=True)
    import_matplotlib() if figure else say_no_figure(context, "--no-figure draws none")
    options = {"oil.name": oil, "thermal.on": thermal}
    changes = changes_of(options, grid, set_ or [])
    base = find(scene)
    check_rows(grid, changes, lambda: base)
    plan = traction_plan(base, srr, temperature, speed, changes, load, hertz_pressure)
    for sentence in doubts(plan):
        say(f"warning: {sentence}")
    with SweepLive(quiet, "repeat the command to resume") as live:
        found = computed(plan, out, workers=workers, threads_per_worker=threads_per_worker, progress=live)
    if figure:
        say(str(found.plot(**vars(page))))
    print_json(found.to_dict()) if as_json else _print(found)
    refuse_missing(found.failed, len(found.study), "case", found.study.path)


def _print(found):
    """Print the table of traction curves, the reasons of missing results, warnings of the cases, and its path."""
    rows = found.rows
    columns = [column for column in COLUMNS if any(row[column[0]] is not None for row in rows)]
    keys = {key: head for key, head in KEYS.items() if key in rows[0]}
    list_table(f"{found.study.plan.scene.name}: traction", (*keys.values(), *(head for _, head, _ in columns)),
               [[*(f"{row[key]:g}" for key in keys), *(_shown(row, key, factor) for key, _, factor in columns)]
                for row in rows], whole=True)
    for row in found.failed:
        put(f"no result: {', '.join(f'{head} {row[key]:g}' for key, head in KEYS.items() if key in row)}: {row['reason']}")
    warning_lines(found.warnings_of_cases)  # others were printed before the runs
    put(f"table: {found.study.table}; study: {found.study.path}")


ROUNDING = 1e-12  # of a friction coefficient in pure rolling
KEYS = {"temperature_C": "deg C", "load_N": "load N", "load_N_m": "load N/m", "p_Hertz_Pa": "p_Hertz Pa", "u_m_m_s": "u_m m/s",
        "srr": "SRR"}
COLUMNS = (("friction_coefficient", "friction", 1), ("h_c_m", "h_c um", 1e6), ("h_min_m", "h_min um", 1e6),
           ("film_max_C", "film deg C", 1))


def _shown(row, key, factor):
    """A number with its error; "" without a result."""
    value, error = row[key], row["error"][key]
    if value is None or abs(value) < ROUNDING:
        return "" if value is None else "0"
    return with_bar(with_error(value * factor, None if error is None else error * factor), error)
