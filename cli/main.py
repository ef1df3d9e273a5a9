"""All commands of `tehl`."""

import contextlib
from typing import Any

import typer
import typer.core
from tehl_cli.animate_command import animate
from tehl_cli.bearing_command import bearing, roller
from tehl_cli.bench_command import bench
from tehl_cli.cam_command import cam
from tehl_cli.cite_command import cite
from tehl_cli.compare_command import compare
from tehl_cli.crack_command import crack
from tehl_cli.entry import main
from tehl_cli.export_command import export
from tehl_cli.fatigue_command import fatigue
from tehl_cli.flank_command import flank
from tehl_cli.key_as_option import with_hint
from tehl_cli.report_command import report
from tehl_cli.run_commands import resume, run, zoom
from tehl_cli.show_commands import doctor, laws, new, oils, plot, scenes, show, steels
from tehl_cli.single_options import Command
from tehl_cli.sweep_command import sweep
from tehl_cli.traction_command import traction

from tehl_taichi import __version__
from tehl_taichi.commit import commit
from tehl_taichi.errors import Interrupted, stopped, typed_options

__all__ = ["app", "main"]


USAGE: Any = typer.BadParameter.__mro__[2]  # of typer's own errors, which it does not give a name


class Commands(typer.core.TyperGroup):
    """Command group in which Ctrl-C ends with a message (typer's own is "Aborted!"), and messages name the refused value."""

    def make_context(self, *words, **options):
        with _printable():
            return super().make_context(*words, **options)

    def invoke(self, ctx):
        try:
            with _printable(), typed_options():
                return super().invoke(ctx)
        except typer.BadParameter as error:
            error.message = _with_value(error)
            raise
        except KeyboardInterrupt as stop:
            with typed_options():
                raise Interrupted(_sentence(stop)) from None


@contextlib.contextmanager
def _printable():
    """Escape unprintable letters in the messages of typer, and say which key of the scene an unknown option may be."""
    try:
        yield
    except USAGE as error:
        from tehl_taichi.values.escape import printable

        error.message = printable(with_hint(error), "\n")
        raise


def _sentence(stop):
    """Message of a KeyboardInterrupt; the default says what is stored."""
    return str(stop) or f"{stopped(stop)}; all stored data are kept"


def _with_value(error):
    """Message of a BadParameter with the value, which typer's own checks (pydantic's) leave out."""
    found: Any = getattr(error.__cause__, "errors", list)()
    return f"{found[0]['input']!r}; {error.message[0].lower()}{error.message[1:]}" if found else error.message


# {heading of the help: its commands}, in this order
PANELS = {"Compute": (run, resume, zoom, sweep, traction, flank, bearing, roller, cam, fatigue, crack),
          "Show results": (show, plot, report, compare, animate, export),
          "Scene files and choices": (new, scenes, oils, steels, laws),
          "This program": (doctor, cite)}

app = typer.Typer(cls=Commands, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False,
                  rich_markup_mode="rich")


@app.callback()
def options(version: bool = typer.Option(False, "--version", help="print the versions and the commit",
                                         callback=lambda given: given and _print_version(), is_eager=True)):
    """Simulate lubricated contacts with surface features: film, pressure, stresses and fatigue.

    Example: tehl run --srr -0.12
    """


def _print_version():
    from importlib.metadata import version
    from platform import python_version

    print(f"tehl_taichi {__version__}, commit {commit()}, Python {python_version()}, taichi {version('taichi')}")
    raise typer.Exit()


for _panel, _functions in PANELS.items():
    for _function in _functions:
        app.command(cls=Command, rich_help_panel=_panel)(_function)
app.add_typer(bench, name="bench", rich_help_panel="This program")
