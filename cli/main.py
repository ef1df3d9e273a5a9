"""The commands."""

import typer
import typer.core
from tehl_cli import bench, fatigue, inspect, runs
from tehl_cli.entry import main

from tehl_taichi.errors import Interrupted

__all__ = ["app", "main"]


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
