"""Report of typed options without effect beside the others, as for keys of a scene."""

from tehl_cli.live_display import say

DRAWS = ("format", "dpi", "figure_width", "force")  # of figures: without one they have nothing to say


def say_idle(context, why, *names):
    """Warn about each of these parameters of the command that the user typed; context: None if Python calls the command."""
    for parameter in context.command.params if context else ():
        if parameter.name in names and context.get_parameter_source(parameter.name).name == "COMMANDLINE":
            say(f"warning: {_typed(parameter, context.params[parameter.name])} has no effect here: {why}")


def say_no_figure(context, why):
    """Warn about typed options of figures; --width is that of a feature in a command with --figure-width."""
    names = [parameter.name for parameter in context.command.params] if context else []
    say_idle(context, why, *DRAWS, *["width"] * ("figure_width" not in names))


def _typed(parameter, value):
    """The option as it was typed."""
    if isinstance(value, bool):
        return (parameter.opts if value else parameter.secondary_opts or parameter.opts)[0]
    return f"{parameter.opts[0]} {value}"
