"""Options that a command does not have, but a scene has as a key: --table of a run is --set fatigue.table."""


def with_hint(error):
    """The message of a usage error; of an unknown option that is the last word of a key, how that key is set."""
    option, command = getattr(error, "option_name", None), getattr(error.ctx, "command", None)
    if not option or "--set" not in _options(command):
        return error.message
    found = keys_of(option)
    if found:
        error.possibilities = ()  # options that are only spelled alike
    return error.message + (f"; did you mean {' or '.join(f'--set {key}=...' for key in found)}?" if found else "")


def keys_of(option):
    """Full keys of the default scene whose last word is that of an option, as --x-min is of grid.x_min."""
    from tehl_taichi.scene import keys, scene

    word = option.lstrip("-").replace("-", "_")
    return [key.replace("feature.0.", "feature.") for key, *_ in keys.every(scene("gear")) if key.rpartition(".")[2] == word]


def _options(command):
    return [name for parameter in getattr(command, "params", ()) for name in parameter.opts]
