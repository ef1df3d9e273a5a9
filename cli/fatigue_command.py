"""tehl fatigue: fatigue search of a store with other constants."""

from pathlib import Path

import typer
from tehl_cli import usual_options as usual
from tehl_cli.fatigue_options import with_fatigue_options
from tehl_cli.idle_options import say_no_figure
from tehl_cli.live_display import Live, say
from tehl_cli.stdout import print_json
from tehl_cli.tables import answer, list_table


@with_fatigue_options
def fatigue(
    store: Path = typer.Argument(..., help="store of a run with a feature, finished or not"),
    context: typer.Context = None,
    figures: usual.Figures = None,
    format: usual.Format = "png", dpi: usual.Dpi = 160, width: usual.Width = 17.0, force: usual.Force = False,
    threads: usual.Threads = None, as_json: usual.AsJson = False,
    **constants,
):
    """Evaluate the fatigue of a stored passage with other constants. The store does not change.

    Example: `tehl fatigue runs/gear-1.zarr --kappa 0.25 --endurance 450e6 --to-x 0.5`
    """
    from tehl_taichi.engine import runtime
    from tehl_taichi.fatigue.overrides import changed
    from tehl_taichi.runs.open_results import open_run
    from tehl_taichi.runs.summary import life
    from tehl_taichi.view.figures import fatigue_figures
    from tehl_taichi.view.figures.figure_style import FigureStyle

    runtime.check(threads=threads)
    page = FigureStyle(format, dpi, width, force)
    page.check_all(figures, fatigue_figures.NAMES) if figures else say_no_figure(context, "it needs --figures")
    run = open_run(store)
    for sentence in _doubts(run.scene, constants):
        say(f"warning: {sentence}")
    with Live() as live:
        result = run.fatigue(**constants, threads=threads, progress=live)
    _show(result, life.part(result.summaries, changed(run.scene, constants).fatigue), as_json)
    if figures:
        from tehl_taichi.view.figures.run_figures import write_fatigue

        for path in write_fatigue(result, run.scene, figures, page):
            say(str(path))


def _doubts(scene, constants):
    """Sentences about constants that have no effect on this passage."""
    from tehl_taichi.fatigue.overrides import changed
    from tehl_taichi.scene import idle_keys

    return idle_keys.doubts(changed(scene, {**constants, "on": True}))


def _show(result, passages, as_json):
    from tehl_taichi.fatigue import judged_surfaces
    from tehl_taichi.runs.summary.summary_rows import fatigue_rows, life_rows

    _, *rest = result.summaries.items()  # that which decides first
    beside = dict(rest)
    if as_json:
        print_json({**result.summary, **passages, "by_surface": result.summaries})
    else:
        list_table("fatigue", ("quantity", "value"), [*fatigue_rows(result.summary, beside), *life_rows(passages)])
        answer(judged_surfaces.parts(result.summaries))
