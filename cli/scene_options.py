"""Changes of a scene by command options and `--set`."""

import tomllib

from tehl_cli.amount import refuse_zeros

from tehl_taichi.errors import SceneError

GRIDS = {"coarse": (128, 32), "medium": (256, 64), "fine": (512, 128)}

# options by another name than their key
WORDS = {("thermal.on", True): "--thermal", ("thermal.on", False): "--isothermal", ("time.steady_only", True): "--steady",
         ("fatigue.on", True): "--fatigue", ("fatigue.on", False): "--no-fatigue",
         ("numerics.estimate_error", True): "--estimate-error", ("numerics.estimate_error", False): "--no-estimate-error"}
NAMES = {"oil.name": "oil", "zoom.factor": "zoom"}  # of options that are not the end of their key


def changes_of(options, grid, settings):
    """{full key: value} of the used options and --set; SceneError if two of them contradict each other."""
    from tehl_taichi.scene.aliases import resolve

    refuse_zeros(options)
    used = [(key, value) for key, value in options.items() if value is not None]
    given = [(_typed(key, value), key, value) for key, value in used]
    given += [(f"--grid {grid}", key, value) for key, value in _grid(grid).items()]
    return resolve([*given, *_settings(settings)])


def _typed(key, value):
    """An option as it was typed."""
    shown = value if isinstance(value, str) else f"{value:g}"
    return WORDS.get((key, value), f"--{NAMES.get(key, key.rpartition('.')[2]).replace('_', '-')} {shown}")


def _grid(text):
    if text is None:
        return {}
    from tehl_taichi.values.checks import nearest

    try:
        counts = GRIDS.get(text) or [int(part) // 2 * 2 for part in text.lower().split("x", 1)]
    except ValueError:
        raise SceneError(f"--grid {text!r} is not known; allowed: {', '.join(GRIDS)} or NXxNY, as in 256x64 (NX alone if "
                         f"nothing varies along y){nearest(text, GRIDS)}") from None
    return dict(zip(("grid.nx", "grid.ny"), counts))


def check_rows(grid, changes, description):
    """Refuse a single number as --grid for a scene that varies along y, where the second number would remain from another grid.
    SceneError.

    grid: as typed; changes: result of :func:`changes_of`; description: function that gives the changed scene.
    """
    if grid is None or "grid.ny" in _grid(grid) or description().one_dimensional:
        return
    nx = changes["grid.nx"]
    raise SceneError(f"--grid {grid} needs a scene in which nothing varies along y; allowed for this scene: {', '.join(GRIDS)} "
                     f"or NXxNY, as in {nx}x{nx // 4}")


def _settings(pairs):
    """(words, key, value) of every --set."""
    out = []
    for pair in pairs:
        key, equals, text = pair.partition("=")
        if not equals or not key.strip():
            raise SceneError(f"--set {pair!r} must have the form dotted.key=value, as in feature.height=1e-6")
        out.append((f"--set {pair}", key.strip(), _value(text)))
    return out


def _value(text):
    """Value of a --set by the rules of TOML; if it is no TOML value, the text itself."""
    try:
        return tomllib.loads(f"v = {text}")["v"]
    except (ValueError, RecursionError):
        return text
