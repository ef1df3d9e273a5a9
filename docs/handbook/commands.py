"""Reference of the commands, from the command line itself."""

import textwrap

import typer.main
from tehl_cli.main import app

from handbook.tables import code, plain, table


def text():
    """Every command with its arguments and options."""
    commands = getattr(typer.main.get_command(app), "commands", {})
    return "\n\n".join(command("tehl", name, found) for name, found in commands.items())


def command(before, name, found):
    """Heading, help and a table; of a group its commands follow."""
    words = f"{before} {name}"
    parts = [f"{'#' * len(words.split())} {code(words)} {{ #{words.replace(' ', '-')} }}", helped(found)]
    if shown := [one for one in found.params if not getattr(one, "hidden", False)]:
        parts.append(table(("argument or option", "default", "meaning"), map(row, shown)))
    inner = getattr(found, "commands", {})
    return "\n\n".join([*parts, *(command(words, name, each) for name, each in inner.items())])


def helped(found):
    """The help of a command; Markdown unchanged, long and short options in it untouched."""
    return textwrap.dedent(found.help or "").strip()


def row(parameter):
    """(its names, default, meaning) of a parameter."""
    argument = parameter.param_type_name == "argument"
    names = code(parameter.name.upper()) if argument else ", ".join(map(code, [*parameter.opts, *parameter.secondary_opts]))
    default = parameter.default
    shown = "" if default is None or default is False or callable(default) else "needed" if default is ... else code(default)
    return names, "needed" if parameter.required else shown, plain(getattr(parameter, "help", None) or "")
