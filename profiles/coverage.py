"""Do the error bars hold? Scenes drawn at random, their bars judged by the same scenes on grids four times as fine and domains
four times as long."""

import contextlib
import json
import math
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
from tehl_taichi.profiles.stability_scenes import log_uniform

from tehl_taichi.disk import user_files
from tehl_taichi.errors import Error
from tehl_taichi.fatigue.index_statistics import NUMBERS
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.march.accuracy.domain_error import DomainError, widened
from tehl_taichi.march.accuracy.error_bars import GridReading, bars
from tehl_taichi.march.passage import march
from tehl_taichi.scene import Scene, SceneError, scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.resolution import FEWEST
from tehl_taichi.scene.rough_surfaces import is_rough
from tehl_taichi.scene.scales import Scales

FINER = LONGER = 4
FARTHEST, WIDEST = 20.0, 12.0  # a, b: ends of the longer domains
FIXED = 0.3  # share of scenes with a domain that the user fixed
# how many of each kind, by the columns that they are drawn for; temperatures on a point contact march in time for long
STEADY = {"line, Moes": (12, (64, 128, 256)), "line": (10, (64, 128, 256)), "line, thermal": (10, (64, 128, 128, 256)),
          "flank, thermal": (8, (64, 128, 256)), "circle, Moes": (8, (64, 64, 128)), "circle": (3, (64, 64, 128)),
          "ellipse, Moes": (6, (64, 64, 128)), "ellipse": (3, (64, 64, 128)), "point, thermal": (2, (64,))}
PASSAGES = {"ridge": 1, "ridge, thermal": 1, "asperity": 2, "asperity, thermal": 1, "ridge on ball": 1,
            "ridge, thick": 2, "ridge, thick, thermal": 1, "asperity, thick": 1}  # thick: films that a short inlet starves
EXITS = {"exit": 10, "exit, thermal": 10}  # of endless features, in one dimension: grids four times as fine are within reach
QUICK = {"line, Moes": (2, (64,)), "line": (1, (64,)), "line, thermal": (1, (64,)), "circle": (1, (32,))}
ROUGH = {"rough": 6, "rough pair": 6, "rough pair, thermal": 2}  # line contacts; one surface ground across, or both
MOVING = {"exits": EXITS, "roughness": ROUGH}  # parts that have no steady scenes
QUICK_MOVING = {"exits": {"exit": 1}, "roughness": {"rough": 1}}
QUICK_COLUMNS, COLUMNS_OF = 128, {"exits": (256, 512), "roughness": (128,)}
PARTS = ("coverage", *MOVING)
DRAWS = 100  # until one is admissible
LIKE_ONE = ("share", "contact")  # shares of a whole, which may be 0
COLUMNS = ("part", "quantity", "bars", "null", "hold", "ratio", "bar", "error")  # of the table
RELATIVE_TO = {"C": 1.0}  # K: temperatures have no natural zero


def battery(seed, quick=False, part="coverage"):
    """[(kind, scene)] of one of the PARTS, the same for the same seed; coverage: steady scenes, passages and rough surfaces;
    quick: a few on coarse grids."""
    rng, whole = np.random.default_rng(seed), part == "coverage"
    kinds = _at_rest(quick) if whole else _moving(part, quick)
    drawn = [(kind, _admissible(rng, kind, columns)) for kind, columns in kinds]
    return drawn + (battery(seed, quick, "roughness") if whole and not quick else [])


def _at_rest(quick):
    """(kind, columns to choose from) of steady scenes and of passages, which choose them themselves."""
    steady, passages = (QUICK, {}) if quick else (STEADY, PASSAGES)
    kinds = [(kind, columns) for kind, (count, columns) in steady.items() for _ in range(count)]
    return kinds + [(kind, None) for kind, count in passages.items() for _ in range(count)]


def _moving(part, quick):
    columns = (QUICK_COLUMNS,) if quick else COLUMNS_OF[part]
    return [(kind, columns) for kind, count in (QUICK_MOVING if quick else MOVING)[part].items() for _ in range(count)]


def _admissible(rng, kind, columns):
    """The first scene drawn that is not refused."""
    moving = {"exit": _exit, "roug": _rough}.get(kind[:4])
    for _ in range(DRAWS):
        with contextlib.suppress(SceneError):
            if columns is None:
                return _passage(rng, kind)
            nx = int(rng.choice(columns))
            return moving(rng, kind, nx) if moving else _steady(rng, kind, nx)
    raise SceneError(f"none of {DRAWS} scenes drawn as {kind!r} is admissible")


def _steady(rng, kind, nx):
    """Steady start on the domain that the scene chooses, or on the usual domain as if the user had set it."""
    line, grid = kind.startswith(("line", "flank")), {"grid.nx": nx}
    if not line:
        grid |= {"grid.ny": nx // 2, "grid.y_max": "auto", "grid.x_min": "auto"}
    if rng.random() < FIXED:
        grid |= {"grid.x_min": -2.5} | ({} if line else {"grid.y_max": 1.5})
    ratio = 1.0 if line or "circle" in kind else log_uniform(rng, 0.3, 4)
    return _moes(rng, line, ratio, grid) if "Moes" in kind else _by_pressure(rng, kind, line, ratio, grid)


def _moes(rng, line, ratio, grid):
    M, round_ = log_uniform(rng, 2 if line else 5, 1000), {} if line else _radii(ratio)
    return scene("smooth-line" if line else "ball-on-disc").replace(**{
        "contact.load": 0.0, "contact.moes_M": M, "contact.moes_L": float(rng.uniform(2, 25)), "oil.name": "moes-test-fluid",
        **round_, **grid})


def _radii(ratio):
    return {"contact.kind": "point" if ratio == 1 else "elliptic", "contact.radius_y": 12.7e-3 * ratio}


def _by_pressure(rng, kind, line, ratio, grid):
    flank, most = kind.startswith("flank"), 2.5e9 if line else 2e9
    pressure = log_uniform(rng, 0.3e9, 0.8e9) if flank else log_uniform(rng, 0.5e9, most)
    changes = {"temperature": float(rng.uniform(50, 120)), "srr": float(rng.uniform(-0.6, 0.6)),
               "thermal.on": "thermal" in kind,
               "speed": log_uniform(rng, 10, 30) if flank else log_uniform(rng, 1, 20 if line else 10)}
    base = scene("smooth-line").to_dict()
    radii = {"radius_x": 10.6e-3} if line else {"radius_x": 12.7e-3, "radius_y": 12.7e-3 * ratio,
                                                "kind": "point" if ratio == 1 else "elliptic"}
    base["contact"] = {**radii, "hertz_pressure": pressure}
    return Scene.from_dict(base).replace(**{**grid, **changes})


def _passage(rng, kind):
    sign = 1.0 if rng.random() < 0.6 else -1.0
    if kind == "ridge on ball":
        return scene("ridge-on-ball").replace(**{"height": sign * log_uniform(rng, 0.1e-6, 0.3e-6),
                                                 "srr": float(rng.choice([-0.5, 0.0, 0.5])), "grid.nx": 64, "grid.ny": 32})
    ridge, thermal, thick = kind.startswith("ridge"), "thermal" in kind, "thick" in kind
    fast = {"hertz_pressure": log_uniform(rng, 0.5e9, 0.9e9), "speed": log_uniform(rng, 10, 25)} if thick else {}
    nx = int(rng.choice([128, 256])) if ridge else 64 if thermal else 128
    return scene("gear").replace(**{
        "feature.shape": "ridge" if ridge else "cosine", "height": sign * log_uniform(rng, 0.3e-6, 1.5e-6),
        "width": log_uniform(rng, 200e-6, 400e-6), "srr": float(rng.uniform(-0.5, 0.5)), "thermal.on": thermal,
        "hertz_pressure": log_uniform(rng, 1e9, 2.2e9), "temperature": float(rng.uniform(60, 100)), "grid.nx": nx,
        "grid.ny": nx // 4, "time.x_end": float("inf") if ridge else 0.0, **fast})


def _rough(rng, kind, nx):
    """Ground surfaces of Ra 0.1 to 0.5 um across, in one dimension; both signs of slip."""
    smooth = scene("gear").replace(**{
        "srr": float(rng.choice([-1.0, 1.0])) * log_uniform(rng, 0.03, 0.3), "hertz_pressure": log_uniform(rng, 1e9, 2.2e9),
        "temperature": float(rng.uniform(60, 100)), "speed": log_uniform(rng, 3.0, 15.0), "thermal.on": "thermal" in kind,
        "grid.nx": nx, "grid.ny": nx // 4})
    s = Scales.of(smooth)
    shortest, surfaces = log_uniform(rng, 1.05, 2.0) * FEWEST * s.cell(smooth.grid)[0], "ab" if "pair" in kind else "a"
    ground = {"shape": "ground", "height": log_uniform(rng, 0.1e-6, 0.5e-6), "width": shortest, "length": math.inf,
              "extent_x": 1.5 * s.a, "taper": 0.15 * s.a}
    return replace(smooth, features=tuple(Feature(surface=name, seed=int(rng.integers(1000)), **ground) for name in surfaces))


def _exit(rng, kind, nx):
    """An asperity or a dent that nothing ends across, until it has left."""
    return scene("gear").replace(**{
        "feature.length": float("inf"), "height": float(rng.choice([-1.0, 1.0])) * log_uniform(rng, 0.5e-6, 1.5e-6),
        "width": log_uniform(rng, 150e-6, 300e-6), "srr": float(rng.choice([0.0, rng.uniform(-0.4, 0.4)], p=[0.2, 0.8])),
        "thermal.on": "thermal" in kind, "hertz_pressure": log_uniform(rng, 1e9, 2.2e9),
        "temperature": float(rng.uniform(60, 100)), "grid.nx": nx, "grid.ny": nx // 4})


def run(path, seed, quick=False, progress=None, part="coverage"):
    """Rows of all scenes of a battery (see :func:`row`), stored in the JSON file `path` one by one."""
    rows, path = [], Path(path)
    for n, (kind, description) in enumerate(battery(seed, quick, part)):
        if progress:
            progress(f"{n + 1}: {kind}, {description.grid.nx} columns")
        rows.append({"kind": kind, "columns": description.grid.nx, **row(description)})
        user_files.text(path, json.dumps({"program": user_files.PROGRAM, "seed": seed, "rows": rows}), force=True)
    return rows


def row(description):
    """{"own": readings per grid or of coarse-grid runs, "finer": {name: value}, "domain": values of its DomainError, "inlet":
    deg C} of one scene, or the reason why it has none; finer: on FINER cells and a LONGER domain."""
    try:
        return _row_of_passage(description) if description.transient else _row_of_start(description)
    except Error as error:
        return {"reason": str(error)}


def on_finer(description):
    """The scene on FINER cells, on the same domain."""
    g = description.grid
    return description.replace(**{"grid.nx": FINER * g.nx, "grid.ny": FINER * g.ny, "grid.x_min": float(g.x_min),
                                  "grid.y_max": float(g.y_max)})


def on_longer(description):
    """The scene on a LONGER domain, on cells as large as before."""
    g, line = description.grid, description.contact.kind == "line"
    x_min, y_max = -min(LONGER * -g.x_min, FARTHEST), g.y_max if line else max(min(LONGER * g.y_max, WIDEST), g.y_max)
    nx = round(g.nx * (g.x_max - x_min) / (g.x_max - g.x_min) / 32) * 32
    return description.replace(**{"grid.x_min": x_min, "grid.y_max": float(y_max), "grid.nx": nx,
                                  "grid.ny": round(g.ny * y_max / g.y_max / 8) * 8})


def truth(description, values):
    """{name: value} on finer cells and a longer domain at once where that is cheap, else both changes of values() added; of
    numbers that a domain with the pressure of the oil beyond it moves."""
    if description.isothermal and description.contact.kind == "line" and not description.transient:
        return values(on_longer(on_finer(description)))
    if is_rough(description):  # the domain hardly moves what single peaks decide, and its runs take as long as the finer ones
        return values(on_finer(description))
    own, fine, far = (values(one) for one in (description, on_finer(description), on_longer(description)))
    return {name: value + far[name] - own[name] for name, value in fine.items() if name in own.keys() & far.keys()}


def _row_of_start(description):
    shot = next(march(description))
    own = [{name: asdict(reading) for name, reading in grid.items()} for grid in shot.grids]
    found = truth(description, lambda one: next(march(one)).scalars)
    return {"own": own, "finer": {name: found[name] for name in own[-1]}, "domain": shot.domain.values(),
            "inlet": description.operation.temperature, "ends": [float(description.grid.x_min), float(description.grid.y_max)]}


def _row_of_passage(description):
    coarser, refused = coarse_runs.scenes(description)
    own = {name: asdict(reading) for name, reading in coarse_runs.values(description).items()}
    answers = [{"reason": reason} for reason in refused] + [coarse_runs.answer(one) for one in coarser]
    found = truth(description, lambda one: {name: reading.value for name, reading in coarse_runs.values(one).items()})
    domain = next(march(description.replace(**{"time.steps": 0}))).domain
    return {"own": own, "answers": answers, "finer": found, "domain": domain.values(),
            "inlet": description.operation.temperature}


def judged(rows):
    """[(part, quantity, value, error bar or None, real error)] of rows of a battery; of rough surfaces the numbers that
    settle."""
    out = []
    for one in rows:
        if "reason" in one:
            continue
        part = "steady" if "answers" not in one else {"exit": "exit", "roug": "roughness"}.get(one["kind"][:4], "passage")
        own, found = _bars(one, part)
        out += [(part, _quantity(name), own[name].value, size, abs(one["finer"][name] - own[name].value))
                for name, size in found.items() if name in one["finer"] and _counts(part, name, own)]
    return out


def _counts(part, name, own):
    """Whether a bar is judged: of what a run states. Of rough surfaces that is what settles, elsewhere no percentiles, no
    friction without slip, and no averaged index that is the one at the nodes (of cells as long as the length)."""
    of_points = name.rpartition(".")[2] in NUMBERS
    if part == "roughness":
        return name.startswith("contact") or of_points
    twin = own.get(name.replace("averaged_", ""))
    at_nodes = "averaged_" in name and twin is not None and twin.value == own[name].value
    return own[name].value != 0 and not at_nodes and (not of_points or name.endswith(NUMBERS[0]))


def _quantity(name):
    """One name for all bodies and depths: "p99, surface" is "a:0 um.p99"."""
    where, _, key = name.rpartition(".")
    if key not in NUMBERS:
        return name
    return f"{key}, {'surface' if where.endswith(':0 um') else 'below'}"


def _bars(one, part):
    """(readings, bars) of a row."""
    if part != "steady":
        own = {name: GridReading(**values) for name, values in one["own"].items()}
        known = coarse_runs.judged(one["answers"], own)
    else:
        grids = [{name: GridReading(**values) for name, values in grid.items()} for grid in one["own"]]
        own, known = grids[-1], bars(grids)
    values = {name: reading.value for name, reading in own.items()}
    share = DomainError.from_values(one.get("domain", {}))
    return own, widened(*known, values, share, one.get("inlet", 0.0), part != "steady")[0]


def table(rows):
    """[(part, quantity, bars stated, not known, share covered, median of bar over real error, median bar, median real error)]
    per quantity and over all; the medians in parts of the value, of a temperature in K."""
    parts = {}
    for one in judged(rows):
        for name in (one[1], "all"):
            parts.setdefault(one[0], {}).setdefault(name, []).append(one)
    return [(part, name, *_line(names[name])) for part, names in parts.items() for name in sorted(names, key="all".__eq__)]


def _line(group):
    stated = [(size, real, _unit(name, value)) for _, name, value, size, real in group if size is not None]
    if not stated:
        return 0, len(group), *[None] * 4
    size, real, unit = (np.array(column) for column in zip(*stated))
    width = size[real > 0] / real[real > 0]  # a share of none that stays so has no ratio
    times = float(np.median(width)) if width.size else None
    return (len(stated), len(group) - len(stated), float(np.mean(real <= size)), times, float(np.median(size / unit)),
            float(np.median(real / unit)))


def _unit(name, value):
    """Value by which the error bar and the error of a number are divided."""
    return 1.0 if name.startswith(LIKE_ONE) else RELATIVE_TO.get(name[-1], abs(value))


def chart(plt, lines):
    """Share of the error bars that hold, of each quantity; lines: of the :func:`table`."""
    figure, ax = plt.subplots(figsize=(7, 0.3 * len(lines) + 1.2), constrained_layout=True)
    ax.barh([f"{name} ({part}, {known} bars)" for part, name, known, *_ in lines],
            [100 * (share or 0.0) for _, _, _, _, share, *_ in lines])
    ax.set(xlabel="error bars that hold, %", xlim=(0, 100))
    ax.invert_yaxis()
    return figure
