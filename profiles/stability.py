"""Stiff and extreme scenes, their fatigue included: each must converge, or stop with its reason; never NaN, a negative film
or a hang."""

import dataclasses
import functools
import time
from dataclasses import dataclass
from typing import Optional

import numpy as np
from tehl_taichi.profiles import measure

from tehl_taichi.laws import rheology
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import Scene, SceneError, overrides, scene, thin_film
from tehl_taichi.scene.feature import SHAPES, Feature
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.resolution import FEWEST
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import AUTO, Rheology
from tehl_taichi.view.figures import palette

LINE, POINT = {"grid.nx": 128, "grid.ny": 32}, {"grid.nx": 64, "grid.ny": 32}
NARROW = {"grid.nx": 304, "grid.ny": 76}  # 20 um are four cells, the fewest that are taken
MOST_STEPS = 600  # of a passage; with temperatures SRR -1.99 would need 25 536, the feature hardly moves in one
FINEST = {"line": 1024, "point": 256}  # columns, of scenes on the grid that their film needs
MOST = {True: 2048, False: 512}  # columns of lines, of points, that are made finer
CONFIRMED = {True: 2048, False: 512}  # the same, of those that are made finer until twice the columns confirm them
FILM_HOLDS, HOLDS_K = 0.01, 1.0  # what half a step and a finer grid may change of a start that they confirm
ROUGH_LINE = {"grid.nx": 128, "grid.ny": 32, "thermal.on": True, "time.x_end": -0.4}  # until the patches reach the middle
RANDOM_LINE, RANDOM_POINT, RANDOM_STEPS = {"grid.nx": 64, "grid.ny": 16}, {"grid.nx": 64, "grid.ny": 16, "grid.y_max": 2.0}, 12
COLOURS = {"converged": palette.GREEN, "refused": palette.GREY, "stopped": palette.ORANGE, "failed": palette.VERMILLION}
# the default first, then in the order that the published figures were drawn in
SHEAR_LAWS = [Rheology.law, *sorted(set(rheology.LAWS) - {Rheology.law}, reverse=True)]


@dataclass(frozen=True)
class CaseOutcome:
    """verdict: converged, refused (at the door), stopped (not converged, with a reason) or failed (NaN, negative film).

    Fi_max: fatigue index of a passage that converged, else None; unsettled: whether it began from a state in time; carried:
    whether the grid carries its film, by the film formula.
    """

    name: str
    verdict: str
    reason: str
    steps: int
    newton: float
    cycles: float
    seconds: float
    Fi_max: Optional[float] = None
    unsettled: bool = False
    carried: bool = False


@dataclass(frozen=True)
class Confirmed:
    """Changes of a start with half the time step and twice the columns: central film (part of it), largest temperature (K);
    None where that start stops. moving: whether one of the three is a state in time, none at rest; reason: why a case is lost
    altogether."""

    name: str
    columns: int
    half_film: Optional[float]
    half_K: Optional[float]
    finer_film: Optional[float]
    finer_K: Optional[float]
    moving: bool = False
    reason: str = ""

    @property
    def holds(self):
        """Whether neither changes the film by more than 1 %, nor the temperature by more than 1 K."""
        return _small(self.half_film, self.half_K) and _small(self.finer_film, self.finer_K)


def cases(thermal=False):
    """{name: scene or SceneError} of the table in validation.md G."""
    out, on = {}, {"thermal.on": thermal}

    def add(name, base="gear", size=LINE, **changes):
        try:
            out[name] = edited(base, {**size, **on, **{key.replace("__", "."): value for key, value in changes.items()}})
        except SceneError as error:
            out[name] = error

    for p in (0.3e9, 1e9, 3e9, 4e9):
        wide = {"grid__x_min": -5.0, "grid__x_max": 4.0} if p < 0.5e9 else {}
        add(f"Hertz pressure {p / 1e9:g} GPa", hertz_pressure=p, **wide)
    for srr in (-1.99, -1.9, -1.0, -0.5, 0.0, 0.5, 1.0, 1.9, 2.0):
        add(f"SRR {srr:+g}", srr=srr)
    for T in (20.0, 60.0, 120.0, 150.0):
        add(f"inlet {T:g} C", temperature=T)
    for height in (0.1e-6, 3e-6, -0.1e-6, -3e-6):
        for width in (20e-6, 400e-6):
            add(f"cosine {height * 1e6:+g} um x {width * 1e6:g} um", size=NARROW if width < 50e-6 else LINE, height=height,
                width=width)
    for speed in (0.01, 0.1, 1.0, 50.0):
        add(f"u_m {speed:g} m/s", speed=speed)
    for law in SHEAR_LAWS[1:]:
        add(f"shear law {law}", rheology__law=law)
    add("one body ten times softer", bodies__b__E=20.6e9)
    add("one body of glass", bodies__b__E=75e9, bodies__b__nu=0.22, bodies__b__k=1.0)
    add("two features", feature=[{}, {"x": 150e-6, "height": -1e-6}])
    for name, shape in SHAPES.items():
        add(f"shape {name}", feature=[dict(shape.example)])
    for name in OILS:
        add(f"oil {name}", oil__name=name)
    for name in CRITERIA:
        add(f"criterion {name}", fatigue__criterion=name)
    add("waviness at the grid limit", feature=[{"shape": "waviness", "height": 0.1e-6, "width": 50e-6, "extent_x": 400e-6,
                                                "extent_y": 400e-6, "taper": 50e-6}])
    for M, L in ((5, 1), (5, 25), (50, 10), (1000, 10), (5000, 5)):
        add(f"line M {M} L {L}", "smooth-line", contact={"moes_M": float(M), "moes_L": float(L)},
            oil__name="moes-test-fluid", grid__x_min=-4.5 if M <= 20 else -2.5)
    for ratio in (0.125, 1.0, 8.0):
        add(f"ellipse R_y/R_x {ratio:g}", "ridge-on-ball", POINT, contact={"kind": "elliptic", "radius_y": ratio * 12.7e-3,
                                                                           "hertz_pressure": 0.54e9})
    for srr in (-1.0, 1.0):
        add(f"ridge on ball SRR {srr:+g}", "ridge-on-ball", POINT, srr=srr)
    return out


def random_cases(count, seed=0):
    """{name: scene or SceneError}: `count` scenes drawn from the whole admissible range, on small grids, the first steps of
    the passage (the feature enters: it starts just in front of the contact). Names of scenes begin with line or point."""
    rng, out = np.random.default_rng(seed), {}
    for n in range(count):
        try:
            drawn = _drawn(rng)
            out[f"random {seed}-{n} {'line' if Scales.of(drawn).line else 'point'}"] = drawn
        except SceneError as error:
            out[f"random {seed}-{n}"] = error
    return out


def _drawn(rng):
    log_uniform = functools.partial(_log_uniform, rng)
    point = rng.random() < 0.3
    contact = {"hertz_pressure": log_uniform(0.3e9, 2e9 if point else 4e9)}
    if point:
        contact |= {"kind": "elliptic", "radius_x": 12.7e-3, "radius_y": 12.7e-3 * log_uniform(1 / 8, 8)}
    law = str(rng.choice(SHEAR_LAWS))
    size = RANDOM_POINT if point else RANDOM_LINE
    smooth = edited("smooth-line", {**size, "srr": float(rng.uniform(-1.9, 2.0)), "temperature": float(rng.uniform(20, 150)),
                                    "speed": log_uniform(0.01, 50.0), "thermal.on": bool(rng.random() < 0.5),
                                    "rheology.law": law, "time.steps": RANDOM_STEPS, "contact": contact,
                                    "bodies.b.E": 206e9 / log_uniform(1, 10)})
    cell = max(Scales.of(smooth).cell(smooth.grid))
    feature = Feature(height=float(rng.choice([-1.0, 1.0])) * log_uniform(0.1e-6, 3e-6),
                      width=log_uniform(max(20e-6, 1.01 * FEWEST * cell), max(400e-6, 2 * FEWEST * cell)),
                      shape=str(rng.choice([name for name, shape in SHAPES.items() if shape.drawn])))
    return dataclasses.replace(smooth, features=(feature,))


def rough_cases(count, seed=0):
    """{name: scene or SceneError}: `count` gear contacts with temperatures and two ground surfaces: Ra 0.1 to 0.5 um and lay of
    each, SRR of both signs, pressure, speed and oil temperature at random; the first steps of the passage."""
    rng, out = np.random.default_rng(seed), {}
    for n in range(count):
        smooth = scene("gear").replace(**ROUGH_LINE, **{"temperature": float(rng.uniform(40, 120)),
                                                        "hertz_pressure": _log_uniform(rng, 0.8e9, 2.5e9),
                                                        "srr": float(rng.choice([-1, 1])) * _log_uniform(rng, 0.02, 0.5),
                                                        "speed": _log_uniform(rng, 2.0, 20.0)})
        pair = [_ground(rng, smooth, name) for name in "ab"]
        try:
            out[f"rough {seed}-{n} {', '.join(marks for marks, _ in pair)}"] = dataclasses.replace(
                smooth, features=tuple(feature for _, feature in pair))
        except SceneError as error:
            out[f"rough {seed}-{n}"] = error
    return out


def _ground(rng, smooth, surface):
    """(lay, ground Feature) of one surface, whose shortest wave the grid of the scene sees."""
    s = Scales.of(smooth)
    shortest, lay = _log_uniform(rng, 1.01, 3.0) * FEWEST * max(s.cell(smooth.grid)), str(rng.choice(["across", "along"]))
    along = shortest * _log_uniform(rng, 3.0, 20.0)
    width, length = (shortest, along) if lay == "across" else (along, shortest)
    return lay, Feature(shape="ground", surface=surface, height=_log_uniform(rng, 0.1e-6, 0.5e-6), width=width, length=length,
                        seed=int(rng.integers(1000)), extent_x=s.a, taper=0.15 * s.a)


def _log_uniform(rng, low, high):
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def edited(base, changes):
    """Scene `base` with dotted changes, and whole tables as a scene file would give them."""
    tables = {key: value for key, value in changes.items() if isinstance(value, (dict, list))}
    plain = {key: value for key, value in changes.items() if key not in tables}
    return Scene.from_dict(overrides.merged(scene(base).replace(**plain).to_dict(), tables))


def carried(chosen):
    """`chosen`, {name: scene or SceneError}, with as many columns as the warning of a film too thin for the grid needs (of
    lines the rows stay), at most FINEST."""
    return {name: description if isinstance(description, SceneError) else _carried(description)
            for name, description in chosen.items()}


def _carried(description):
    g, line = description.grid, Scales.of(description).line
    most = max(g.nx, FINEST["line" if line else "point"])
    nx, ny = thin_film.needed(description, most) or (most, g.ny * most // g.nx)
    return description.replace(**{"grid.nx": nx, "grid.ny": g.ny if line else ny})


def starts(chosen):
    """The scenes with temperatures of {name: scene or SceneError}, each to be run for a step after its start."""
    return {name: description.replace(**{"time.steps": 1} if description.transient else {})
            for name, description in chosen.items() if isinstance(description, Scene) and not description.isothermal}


def run(chosen, precision=AUTO, workers=1, threads=None):
    """Generator of a CaseOutcome for each of `chosen` (pairs of a name and a scene or SceneError), in the order in which they
    end.

    workers: processes side by side, each on `threads` threads (None: all that are left).
    """
    jobs = [(name, description, precision) for name, description in chosen]
    for number, found in measure.side_by_side(run_case, jobs, workers, threads):
        lost = isinstance(found, pool.LostJob)
        yield CaseOutcome(jobs[number][0], "failed", found.reason, 0, 0.0, 0.0, 0.0) if lost else found


def run_case(name, description, precision=AUTO):
    """March one scene to its end with linear solves in `precision`, and search the fatigue of a passage. Returns an Outcome."""
    from tehl_taichi.errors import NotConverged
    from tehl_taichi.fatigue import assessment
    from tehl_taichi.march.passage import march, total_steps

    started, shots, newton, cycles = time.perf_counter(), [], 0.0, 0.0
    verdict, reason, index = "converged", "", None
    if isinstance(description, SceneError):
        return CaseOutcome(name, "refused", str(description), 0, 0.0, 0.0, 0.0)
    description = description.replace(**{"numerics.precision": precision})
    if total_steps(description) > MOST_STEPS:
        description = description.replace(**{"time.steps": MOST_STEPS})
    try:
        for shot in march(description):
            newton, cycles = newton + shot.scalars["newton"], cycles + shot.scalars["cycles"] * bool(shots)
            shots.append(shot)
            if not sound(shot):
                verdict, reason = "failed", f"NaN or negative film at step {shot.step}"
                break
        if verdict == "converged" and description.has_fatigue and len(shots) > 2:
            index = assessment.run(description, shots).summary["Fi_max"]
            if not 0 <= index < np.inf:
                verdict, reason = "failed", f"fatigue index {index}"
    except NotConverged as error:
        verdict, reason = "stopped", str(error)
    except SceneError as error:  # single precision for a film too thin for it
        verdict, reason = "failed" if shots else "refused", str(error)
    except Exception as error:  # noqa: BLE001  anything else is what the suite looks for
        verdict, reason = "failed", repr(error)
    steps = max(len(shots) - 1, 0)
    count, seconds = max(steps, 1), time.perf_counter() - started
    unsettled = shots[0].unsettled if shots else ""
    return CaseOutcome(name, verdict, reason or unsettled, steps, newton / count, cycles / count, seconds, index,
                       bool(unsettled),
                   thin_film.carried(description) >= 1)


def confirm(chosen, workers=1, threads=None, again=0):
    """Generator of a Confirmed for each of `chosen`, {name: scene}, in the order in which they end.

    again: doublings, at most, of a grid on which a start does not hold, up to CONFIRMED columns.
    """
    jobs = [(name, description, again) for name, description in chosen.items()]
    for number, found in measure.side_by_side(confirmed, jobs, workers, threads):
        lost = isinstance(found, pool.LostJob)
        name, description, _ = jobs[number]
        yield Confirmed(name, description.grid.nx, None, None, None, None, reason=found.reason) if lost else found


def confirmed(name, description, again=0):
    """The start of a scene three times: as it is, on twice the columns, and with half the time step; where it does not hold the
    same on twice the columns, `again` times at most. Returns the last Confirmed."""
    own, most = _start(description), CONFIRMED[Scales.of(description).line]
    while True:
        twice = doubled(description)
        finer, last = _start(twice), again == 0 or twice.grid.nx > most
        half = _start(_halved(description)) if last or _small(*_change(own, finer)) else None  # else the grid has decided
        found = Confirmed(name, description.grid.nx, *_change(own, half), *_change(own, finer),
                          any(state[2] for state in (own, half, finer) if state))
        if last or found.holds:
            return found
        description, own, again = twice, finer, again - 1


def _halved(description):
    return description.replace(**{"time.courant": 0.5 * description.time.courant})


def _change(own, other):
    """(part of the film, K) between two starts, (None, None) where one stops."""
    return (abs(other[0] / own[0] - 1), abs(other[1] - own[1])) if own and other else (None, None)


def _small(film, kelvin):
    """Whether a start that changes by so much holds."""
    return film is not None and film <= FILM_HOLDS and kelvin <= HOLDS_K


def doubled(description, times=1):
    """The scene on a grid doubled so many times; of lines, whose starts have one row, the rows stay."""
    g, line = description.grid, Scales.of(description).line
    return description.replace(**{"grid.nx": g.nx << times, "grid.ny": g.ny << (0 if line else times)})


def finer(chosen, times):
    """`chosen`, {name: scene or SceneError}, on grids doubled so many times, as long as they have no more than MOST columns."""
    return {name: _doubled_up_to(one, times, MOST[Scales.of(one).line]) if isinstance(one, Scene) else one
            for name, one in chosen.items()}


def _doubled_up_to(description, times, most):
    for _ in range(times):
        if 2 * description.grid.nx <= most:
            description = doubled(description)
    return description


def _start(description):
    """(central film, m, largest temperature, deg C, whether it is a state in time) of a start, or None where it stops."""
    from tehl_taichi.errors import NotConverged
    from tehl_taichi.march.passage import march

    try:
        shot = next(march(description))
    except (NotConverged, SceneError):
        return None
    return shot.scalars["h_c_m"], shot.scalars["film_max_C"], bool(shot.unsettled)


def sound(shot):
    """No NaN, no negative film or pressure."""
    p, h = shot.fields["pressure"], shot.fields["film"]
    return bool(np.isfinite(p).all() and np.isfinite(h).all() and p.min() >= 0 and h.min() > 0)


def chart(plt, found):
    """Krylov iterations and seconds of a step of every case, by its verdict; those that did not converge are named."""
    figure, ax = plt.subplots(figsize=(7, 4.6), constrained_layout=True)
    for verdict, colour in COLOURS.items():
        own = [one for one in found if one.verdict == verdict]
        steps = [one.seconds / max(one.steps, 1) for one in own]
        cycles = [one.cycles for one in own]
        ax.scatter(steps, cycles, s=16, color=colour, label=f"{len(own)} {verdict}")
        for one, x, y in zip(own, steps, cycles):
            if verdict != "converged":
                ax.annotate(one.name, (x, y), fontsize=6, xytext=(3, 2), textcoords="offset points")
    ax.set(xlabel="seconds a step", ylabel="Krylov iterations a step")
    ax.set_xscale("symlog", linthresh=1e-3)
    ax.set_yscale("symlog", linthresh=1)
    ax.legend(fontsize=8)
    return figure


def changes_chart(plt, found):
    """Changes of every start with half the time step and twice the columns, and the allowed changes."""
    figure, ax = plt.subplots(figsize=(5.4, 4.6), constrained_layout=True)
    for which, label in (("half", "half the time step"), ("finer", "twice the columns")):
        pairs = [(100 * one[f"{which}_film"], one[f"{which}_K"]) for one in found if one[f"{which}_film"] is not None]
        ax.scatter(*(np.maximum(values, 1e-6) for values in (zip(*pairs) if pairs else ((), ()))), s=16, label=label)
    ax.axvline(100 * FILM_HOLDS, color=palette.RULE)
    ax.axhline(HOLDS_K, color=palette.RULE)
    ax.set(xlabel="change of the central film, %", ylabel="change of the largest temperature, K", xscale="log", yscale="log")
    ax.legend(fontsize=8)
    return figure
