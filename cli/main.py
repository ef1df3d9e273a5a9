"""All commands of `tehl`."""

import contextlib
from typing import Any

import typer
import typer.core
from tehl_cli import (
    animate_command,
    bearing_command,
    bench_command,
    cam_command,
    cite_command,
    compare_command,
    crack_command,
    export_command,
    fatigue_command,
    flank_command,
    report_command,
    run_commands,
    show_commands,
    steels_command,
    sweep_command,
    traction_command,
)
from tehl_cli.entry import main
from tehl_cli.key_as_option import with_hint
from tehl_cli.single_options import Command

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
PANELS = {"Compute": ("run", "resume", "zoom", "sweep", "traction", "flank", "bearing", "roller", "cam", "fatigue", "crack"),
          "Show results": ("show", "plot", "report", "compare", "animate", "export"),
          "Scene files and choices": ("new", "scenes", "oils", "steels", "laws"),
          "This program": ("doctor", "bench", "cite")}

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

    from tehl_taichi import __version__
    from tehl_taichi.commit import commit

    print(f"tehl_taichi {__version__}, commit {commit()}, Python {python_version()}, taichi {version('taichi')}")
    raise typer.Exit()


run_commands.register(app)
sweep_command.register(app)
traction_command.register(app)
show_commands.register(app)
animate_command.register(app)
steels_command.register(app)
fatigue_command.register(app)
crack_command.register(app)
flank_command.register(app)
bearing_command.register(app)
cam_command.register(app)
compare_command.register(app)
export_command.register(app)
report_command.register(app)
bench_command.register(app)
cite_command.register(app)


def _use_command_class():
    """Let all commands, also those of groups, parse their options alike."""
    for group in filter(None, (app, *(one.typer_instance for one in app.registered_groups))):
        for command in group.registered_commands:
            command.cls = Command


def _sort():
    """Sort the commands in the order of PANELS, each below its heading."""
    panels = {name: panel for panel, names in PANELS.items() for name in names}
    for command in app.registered_commands:
        function: Any = command.callback
        command.name = command.name or function.__name__
        command.rich_help_panel = panels[command.name]
    app.registered_commands.sort(key=lambda command: list(panels).index(str(command.name)))
    for group in app.registered_groups:
        group.rich_help_panel = panels[str(group.name)]


_use_command_class()
_sort()
