"""tehl bench stability: stiff and extreme scenes."""

from pathlib import Path
from typing import Optional

import typer
from tehl_cli.bench_options import FORCE, JSON, OUT, THREADS, WORKERS, WRITE
from tehl_cli.idle_options import say_idle
from tehl_cli.live_display import say
from tehl_cli.suite_results import Results, texts

from tehl_taichi.errors import SceneError


def stability(
    context: typer.Context,
    out: Path = OUT,
    match: str = typer.Option("", help="run only the cases with this text in their name"),
    thermal: bool = typer.Option(False, "--thermal/--isothermal", help="run the table with temperatures"),
    random: int = typer.Option(200, min=0, help="number of random scenes after the table"),
    rough: int = typer.Option(0, min=0, help="number of random contacts of two ground surfaces, with temperatures, after them"),
    seed: int = typer.Option(0, min=0, help="seed of the random scenes"),
    quick: bool = typer.Option(False, "--quick", help="run every sixth case and eight random scenes"),
    only_starts: bool = typer.Option(False, "--starts", help="run only scenes with temperatures: the steady start and one "
                                                             "step"),
    by_film: bool = typer.Option(False, "--grid-by-film", help="choose the number of columns from the film formula"),
    confirm: bool = typer.Option(False, "--confirm", help="check the starts with temperatures against half the time step and "
                                                          "twice the columns"),
    again: int = typer.Option(0, min=0, max=6, help="with --confirm: largest number of doublings of a grid on which a start "
                                                    "does not hold, up to 2048 columns (point contacts: 256)"),
    finer: int = typer.Option(0, min=0, max=4, help="number of doublings of every grid before the runs, up to 2048 columns "
                                                    "(point contacts: 512)"),
    as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
    threads: Optional[int] = THREADS, workers: int = WORKERS,
    precision: str = typer.Option("auto", help="precision of the linear solves: f32, f64 or auto (chosen for each scene)"),
):
    """Run stiff and extreme scenes; each converges, is refused, stops or fails. Example: `tehl bench stability`"""
    from tehl_taichi.profiles import confirmed_starts, stability_scenes
    from tehl_taichi.profiles import stability as suite

    results = Results(out, "starts" if confirm else "stability", force, as_json, write=write and not confirm)
    _say_idle(context, confirm, random or rough)
    listed = stability_scenes.cases(thermal)
    drawn = (stability_scenes.random_cases(min(random, 8) if quick else random, seed)
             | stability_scenes.rough_cases(min(rough, 2) if quick else rough, seed))
    chosen = {name: description for name, description in (*list(listed.items())[:: 6 if quick else 1], *drawn.items())
              if match.lower() in name.lower()}
    chosen = suite.starts(chosen) if only_starts or confirm else chosen
    _check_any(chosen, match, only_starts or confirm, [*listed, *drawn])
    chosen = confirmed_starts.finer(suite.carried(chosen) if by_film else chosen, finer)
    if confirm:
        return _confirm(results, chosen, workers, threads, again)
    found = _outcomes(chosen, precision, workers, threads)
    results.documented(("scenes", *_verdicts(found)), [(kind, *map(str, _verdicts(part).values()))
                                                       for kind, part in _parts(found, listed).items() if part])
    _finish(results, found, "stability" + (" with temperatures" if thermal else ""))


def _say_idle(context, confirm, drawn):
    """Report options without effect beside the others."""
    if confirm:
        say_idle(context, "--confirm takes all starts, each in its own precision", "only_starts", "precision")
        say_idle(context, "docs/performance.md has no table that --confirm writes", "write")
    else:
        say_idle(context, "it applies to --confirm only", "again")
    if not drawn:
        say_idle(context, "--random 0 draws no scenes", "seed")


def _check_any(chosen, match, starts, names):
    """Refuse a choice without scenes. SceneError."""
    if not chosen:
        kind = "scene with temperatures" if starts else "scene"
        raise SceneError(f"--match {match!r} is in the name of no {kind}; names: {', '.join(names[:3])}, ...")


def _outcomes(chosen, precision, workers, threads):
    """Run the scenes; returns their outcomes in the order of the scenes."""
    from tehl_taichi.profiles.stability import run

    found = []
    for outcome in run(chosen.items(), precision, workers, threads):
        found.append(outcome)
        say(f"{outcome.name}: {outcome.verdict} {outcome.reason}")
    return sorted(found, key=lambda outcome: list(chosen).index(outcome.name))


def _parts(outcomes, listed):
    """{kind: its outcomes}: scenes of the table, random ones, rough ones."""
    others = [o for o in outcomes if o.name not in listed]
    return {"table": [o for o in outcomes if o.name in listed],
            "random": [o for o in others if not o.name.startswith("rough ")],
            "rough": [o for o in others if o.name.startswith("rough ")]}


def _verdicts(outcomes):
    """{verdict: number of scenes}."""
    return {verdict: sum(o.verdict == verdict for o in outcomes) for verdict in ("converged", "refused", "stopped", "failed")}


def _finish(results, found, title):
    """Print the table and the counts, write the files, and exit with the code of the suite."""
    from tehl_taichi.profiles import stability as suite

    counts = {**_verdicts(found), "unsettled": sum(o.unsettled for o in found), "carried": sum(o.carried for o in found),
              "carried_converged": sum(o.carried and o.verdict == "converged" for o in found)}
    columns = {"case": "{}", "verdict": "{}", "steps": "{}", "newton": "{:.1f}", "cycles": "{:.0f}", "seconds": "{:.1f}",
               "Fi_max": "{:.3f}"}
    results.table(title, columns, texts([{**vars(o), "case": o.name} for o in found], columns))
    say("{converged} converged ({unsettled} of them from a start that did not settle), {refused} refused, {stopped} stopped, "
        "{failed} failed; {carried_converged} of {carried} whose film the grid carries converged".format(**counts))
    results.finish([vars(o) for o in found], lambda plt: suite.chart(plt, found), **counts)
    raise typer.Exit(1 if counts["failed"] else 0)


def _confirm(results, chosen, workers, threads, again):
    from tehl_taichi.profiles import confirmed_starts

    found = []
    for one in confirmed_starts.confirm(chosen, workers, threads, again):
        found.append({**vars(one), "holds": one.holds})
        changes = ", ".join(f"{key} {value:.2g}" for key, value in vars(one).items() if isinstance(value, float))
        say(f"{one.name}: {one.reason or f'{one.columns} columns, ' + (changes or 'stops')}")
    counts = {"starts": len(found), "holds": sum(one["holds"] for one in found),
              "moving": sum(one["holds"] and one["moving"] for one in found)}
    rows = [{**one, **{key: 100 * one[key] for key in ("half_film", "finer_film") if one[key] is not None}} for one in found]
    columns = {"name": "{}", "columns": "{}", **dict.fromkeys(("half_film", "half_K", "finer_film", "finer_K"), "{:.2f}")}
    results.table("change by half the time step and by twice the columns: h_c in %, temperature in K", columns,
                  texts(rows, columns))
    say("{holds} of {starts} starts hold: neither changes their film by more than 1 %, nor their temperature by more than 1 K "
        "({moving} of them states in time)".format(**counts))
    results.finish(found, lambda plt: confirmed_starts.changes_chart(plt, found), **counts)
