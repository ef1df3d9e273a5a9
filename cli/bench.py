"""tehl bench: the suites under profiles/."""

from typing import Optional

import typer
from tehl_cli.live import say


def register(app):
    """Add the group of commands to the app."""
    bench = typer.Typer(no_args_is_help=True, help="Benchmark suites; each prints a table, none asserts.")
    bench.command()(stability)
    bench.callback()(lambda: None)  # a group even with one command
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
