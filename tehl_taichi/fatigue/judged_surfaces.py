"""Searches of the bodies in a summary, the one that decides the verdict first; the body that is not searched."""

from tehl_taichi.errors import SceneError


def by_surface(summary):
    """{surface: summary of its search} of a run's summary, {} without fatigue; runs before 0.9 searched only body a."""
    if "fatigue" not in summary:
        return {}
    return summary.get("fatigue_by_surface", {summary["fatigue"].get("surface", "a"): summary["fatigue"]})


def parts(searches):
    """{part of a summary: value} of {surface: summary of its search}, the body that decides first; {} without any."""
    return {"fatigue": next(iter(searches.values())), "fatigue_by_surface": searches} if searches else {}


def resting(name):
    """The SceneError about a surface at rest."""
    return SceneError(f"surface {name} is at rest: its points are always under load and have no cycle; allowed: the other one")


def others(summary):
    """Searches without that of the body that decides, which is the "fatigue" of the summary."""
    return {name: found for name, found in by_surface(summary).items() if name != summary["fatigue"].get("surface", "a")}
