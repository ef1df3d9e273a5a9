"""Options that were typed and change nothing beside the others: they are reported, as keys of a scene are."""

from tehl_cli.live_display import say

DRAWS = ("format", "dpi", "width", "figure_width", "force")  # of figures: without one they have nothing to say


def say_idle(context, why, *names):
    """A warning for each of these parameters of the command that the user typed; context: None where Python calls it."""
    for parameter in context.command.params if context else ():
        if parameter.name in names and context.get_parameter_source(parameter.name).name == "COMMANDLINE":
            say(f"warning: {_typed(parameter, context.params[parameter.name])} has no effect here: {why}")


def _typed(parameter, value):
    """The option with its value, as it is typed."""
    if isinstance(value, bool):
        return (parameter.opts if value else parameter.secondary_opts or parameter.opts)[0]
    return f"{parameter.opts[0]} {value}"
