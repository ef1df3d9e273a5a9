"""Entry point: the commands, and one place that turns errors into a sentence and an exit code."""

import sys

import typer
import typer.core
from tehl_cli import bench, fatigue, inspect, runs

from tehl_taichi.errors import FAILED, Interrupted


class Commands(typer.core.TyperGroup):
    """The commands; Ctrl-C in any of them is one more error that ends in a sentence (typer's own end is "Aborted!")."""

    def invoke(self, ctx):
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            raise Interrupted("interrupted; nothing that was stored is lost") from None


app = typer.Typer(cls=Commands, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False,
                  rich_markup_mode="rich",
                  help="Lubricated contacts with surface features: film, pressure, stresses, fatigue.\n\n"
                       "Example: tehl run --srr -0.12")
runs.register(app)
inspect.register(app)
fatigue.register(app)
bench.register(app)


def main():
    """Run the command line; exit codes: 0 done, 2 bad input, 3 not converged, 4 interrupted, 1 anything else."""
    debug = "--debug" in sys.argv
    if debug:
        sys.argv.remove("--debug")
    try:
        app()
    except Exception as error:  # noqa: BLE001  every failure ends in one sentence
        if debug:
            raise
        print(f"tehl: {error or type(error).__name__}", file=sys.stderr)
        sys.exit(getattr(error, "exit_code", FAILED))
