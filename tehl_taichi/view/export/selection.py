"""Selection of moments and of surface points of a run."""

from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.coerce import plain, shown
from tehl_taichi.values.units import amount

BEYOND = 0.5  # steps that a position may lie beyond the stored passage: its nearest entry still is the nearest of all steps


@dataclass(frozen=True)
class Selection:
    """at: {requested position (a): nearest entry of the store}; points: (x, y) of surface points, m, x from the centre of the
    feature (without a passage: of the contact), y from that of the contact, as in the summary of a fatigue search.
    """

    at: dict
    points: tuple

    @classmethod
    def of(cls, reader, at, point):
        """Selection from a store. Raises SceneError for positions and points that it does not have."""
        at, point = plain(at), plain(point)
        at = at if isinstance(at, tuple) else (at,)
        several = isinstance(point, tuple) and all(isinstance(one, tuple) for one in point)
        points = point if several else (point,)
        if not at and len(reader) > 1:
            at = (min(max(0.0, _passed(reader)[0]), _passed(reader)[-1]),)
        positions = [amount("at", position, "a", -1e3, 1e3) for position in at]
        return cls({position: _entry(reader, position) for position in positions}, tuple(_point(reader, one) for one in points))


def _passed(reader):
    """Positions of the feature (a) at every entry after the steady start."""
    return reader.scalar("feature_x")[1:] / Scales.of(reader.scene).a


def _entry(reader, at):
    if len(reader) < 2:
        raise SceneError(f"at = {at:g} a: {reader.path} has no passage, only the steady contact")
    passed = _passed(reader)
    step = abs(passed[-1] - passed[0]) / max(passed.size - 1, 1)
    if not passed.min() - BEYOND * step <= at <= passed.max() + BEYOND * step:
        raise SceneError(f"at = {at:g} a: the feature moves from {passed.min():.2f} to {passed.max():.2f} a in {reader.path}")
    return 1 + nearest_index(passed, at)


def _point(reader, point):
    if not isinstance(point, tuple) or len(point) != 2:
        raise SceneError(f"point = {shown(point)} must be two numbers, x and y in m")
    low, high = float(reader.y[0]), float(reader.y[-1])
    return (amount("x of a point", point[0], "m", -0.1, 0.1, usual=1e-4),
            amount("y of a point", point[1], "m", low, high, usual=1e-4))
