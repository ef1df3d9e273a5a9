"""Parts of a summary of each body that was searched, the worse one first; the body that is not searched."""

from tehl_taichi.errors import SceneError


def by_surface(summary):
    """{surface: summary of its search} of a run's summary, {} of one without; runs before 0.9 searched body a alone."""
    if "fatigue" not in summary:
        return {}
    return summary.get("fatigue_by_surface", {summary["fatigue"].get("surface", "a"): summary["fatigue"]})


def resting(name):
    """The SceneError of a surface at rest."""
    return SceneError(f"surface {name} is at rest: its points are always under load and have no cycle; allowed: the other one")


def others(summary):
    """Searches without that of the worse body, whose search is the "fatigue" of the summary."""
    return {name: found for name, found in by_surface(summary).items() if name != summary["fatigue"].get("surface", "a")}
