"""tehl bench: the suites under profiles/."""

import json
from pathlib import Path
from typing import Optional

import typer
from tehl_cli.live import say


def register(app):
    """Add the group of commands to the app."""
    bench = typer.Typer(no_args_is_help=True, help="Benchmark suites; each prints a table, none asserts.")
    bench.command()(stability)
    bench.command()(conclusions)
    app.add_typer(bench, name="bench")


def stability(
    match: str = typer.Option("", help="only cases with this text in their name"),
    thermal: bool = typer.Option(False, "--thermal/--isothermal", help="with temperatures"),
    threads: Optional[int] = typer.Option(None, help="CPU threads (default: all)"),
):
    """Stiff and extreme scenes: converged, refused, stopped with the reason, or failed. Example: `tehl bench stability`"""
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles.stability import cases, run_case

    from tehl_taichi import runtime

    runtime.start(threads=threads)
    rows = []
    for name, description in cases(thermal).items():
        if match.lower() in name.lower():
            o = run_case(name, description)
            say(f"{o.name}: {o.verdict} {o.reason}")
            rows.append((o.name, o.verdict, str(o.steps), f"{o.newton:.1f}", f"{o.cycles:.0f}", f"{o.seconds:.1f}"))
    list_table("stability" + (" with temperatures" if thermal else ""),
               ("case", "verdict", "steps", "newton/step", "cycles/step", "s"), rows)
    raise typer.Exit(1 if any(row[1] == "failed" for row in rows) else 0)


def conclusions(
    out: Path = typer.Option(Path("runs/conclusions"), help="folder of the stores (used again) and of the results"),
    quick: bool = typer.Option(False, "--quick", help="the reference asperity and dent on coarse grids"),
    threads: Optional[int] = typer.Option(None, help="CPU threads (default: all)"),
):
    """What the thesis concludes, with errors: Findley stress by slip, feature, pressure, part of the passage.

    Example: `tehl bench conclusions --quick`
    """
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles import conclusions as suite

    from tehl_taichi import runtime
    from tehl_taichi.scene import scene

    runtime.start(threads=threads)
    rows = suite.run(out, quick, say)
    base = scene("gear")
    judged = suite.verdicts(rows, base.fatigue.endurance)
    list_table("Findley stress, MPa", ("case", *suite.WINDOWS), [(r.name, *suite.cells(r)) for r in rows])
    list_table("the thesis' conclusions", ("statement", "verdict", "figures"), judged)
    (out / "conclusions.md").write_text(suite.page(rows, judged, base))
    (out / "conclusions.json").write_text(json.dumps([
        {"case": r.name, "reason": r.reason, "friction": r.friction, "findley_stress_Pa": {
            "; ".join(key): [value, r.errors[key]] for key, value in r.values.items()}} for r in rows], indent=1))
    say(f"wrote {out}/conclusions.md and conclusions.json")
