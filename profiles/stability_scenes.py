"""Scenes of the stability suite: a table of stiff and extreme ones, random ones, and pairs of rough surfaces."""

import dataclasses
import functools

import numpy as np

from tehl_taichi.laws import rheology
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.scene import Scene, SceneError, overrides, scene
from tehl_taichi.scene.feature import SHAPES, Feature
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.resolution import FEWEST
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.sections import Rheology

LINE, POINT = {"grid.nx": 128, "grid.ny": 32}, {"grid.nx": 64, "grid.ny": 32}
NARROW = {"grid.nx": 304, "grid.ny": 76}  # 20 um are four cells, the fewest that are taken
ROUGH_LINE = {"grid.nx": 128, "grid.ny": 32, "thermal.on": True, "time.x_end": -0.4}  # until the patches reach the middle
RANDOM_LINE, RANDOM_POINT, RANDOM_STEPS = {"grid.nx": 64, "grid.ny": 16}, {"grid.nx": 64, "grid.ny": 16, "grid.y_max": 2.0}, 12
# the default first, then in the order that the published figures were drawn in
SHEAR_LAWS = [Rheology.law, *sorted(set(rheology.LAWS) - {Rheology.law}, reverse=True)]


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
    between = functools.partial(log_uniform, rng)
    point = rng.random() < 0.3
    contact = {"hertz_pressure": between(0.3e9, 2e9 if point else 4e9)}
    if point:
        contact |= {"kind": "elliptic", "radius_x": 12.7e-3, "radius_y": 12.7e-3 * between(1 / 8, 8)}
    law = str(rng.choice(SHEAR_LAWS))
    size = RANDOM_POINT if point else RANDOM_LINE
    smooth = edited("smooth-line", {**size, "srr": float(rng.uniform(-1.9, 2.0)), "temperature": float(rng.uniform(20, 150)),
                                    "speed": between(0.01, 50.0), "thermal.on": bool(rng.random() < 0.5),
                                    "rheology.law": law, "time.steps": RANDOM_STEPS, "contact": contact,
                                    "bodies.b.E": 206e9 / between(1, 10)})
    cell = max(Scales.of(smooth).cell(smooth.grid))
    feature = Feature(height=float(rng.choice([-1.0, 1.0])) * between(0.1e-6, 3e-6),
                      width=between(max(20e-6, 1.01 * FEWEST * cell), max(400e-6, 2 * FEWEST * cell)),
                      shape=str(rng.choice([name for name, shape in SHAPES.items() if shape.drawn])))
    return dataclasses.replace(smooth, features=(feature,))


def rough_cases(count, seed=0):
    """{name: scene or SceneError}: `count` gear contacts with temperatures and two ground surfaces: Ra 0.1 to 0.5 um and lay of
    each, SRR of both signs, pressure, speed and oil temperature at random; the first steps of the passage."""
    rng, out = np.random.default_rng(seed), {}
    for n in range(count):
        smooth = scene("gear").replace(**ROUGH_LINE, **{"temperature": float(rng.uniform(40, 120)),
                                                        "hertz_pressure": log_uniform(rng, 0.8e9, 2.5e9),
                                                        "srr": float(rng.choice([-1, 1])) * log_uniform(rng, 0.02, 0.5),
                                                        "speed": log_uniform(rng, 2.0, 20.0)})
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
    shortest, lay = log_uniform(rng, 1.01, 3.0) * FEWEST * max(s.cell(smooth.grid)), str(rng.choice(["across", "along"]))
    along = shortest * log_uniform(rng, 3.0, 20.0)
    width, length = (shortest, along) if lay == "across" else (along, shortest)
    return lay, Feature(shape="ground", surface=surface, height=log_uniform(rng, 0.1e-6, 0.5e-6), width=width, length=length,
                        seed=int(rng.integers(1000)), extent_x=s.a, taper=0.15 * s.a)


def log_uniform(rng, low, high):
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def edited(base, changes):
    """Scene `base` with dotted changes, and whole tables as a scene file would give them."""
    tables = {key: value for key, value in changes.items() if isinstance(value, (dict, list))}
    plain = {key: value for key, value in changes.items() if key not in tables}
    return Scene.from_dict(overrides.merge(scene(base).replace(**plain).to_dict(), tables))
