"""The built-in scenes on a coarse grid: a table of what comes out, and a sheet of centrelines.

python profiles/examples/gallery.py --out docs/gallery.png          (five minutes of one core; the gallery of the documentation)
python profiles/examples/gallery.py dent --grid 64x16 --steps 3     (one of them, a few steps)
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import tehl_taichi as tehl
from tehl_taichi.scene import BUILT_INS

COLUMNS = ("scene", "p_H, GPa", "steady h_c, µm", "steady h_min, µm", "passage p_max, GPa", "passage h_min, µm",
           "film, °C", "Fi_max", "load on solids")


def described(name, grid, steps):
    """The built-in scene on this grid ("128x32"), without coarse-grid runs."""
    nx, ny = (int(part) for part in grid.split("x"))
    changes = {"grid.nx": nx, "grid.ny": ny, "numerics.estimate_error": False}
    return tehl.scene(name).replace(**changes, **({"time.steps": steps} if steps is not None else {}))


def row(run):
    """Numbers of its summary, as text in the order of COLUMNS."""
    s, p = run.summary["steady"], run.summary.get("transient", {})
    heat, Fi = {**s, **p}.get("film_max_C"), run.summary.get("fatigue", {}).get("Fi_max")  # None: too much friction
    values = (run.summary["hertz"]["p_Pa"] / 1e9, s["h_c_m"] * 1e6, s["h_min_m"] * 1e6, p.get("p_max_Pa", np.nan) / 1e9,
              p.get("h_min_m", np.nan) * 1e6, np.nan if heat is None else heat,
              np.nan if Fi is None else Fi, p.get("contact_load_fraction_max", np.nan))
    return [run.scene.name, *("" if np.isnan(value) else f"{value:.3g}" for value in values)]


def in_the_middle(store):
    """Number of the stored entry with the feature nearest to X = 0; 0, the steady contact, without a passage."""
    return min(range(len(store)), key=lambda n: abs(store.feature_x(n))) if len(store) > 1 else 0


def centreline(axes, run):
    """Pressure (GPa) and film (µm) along y = 0, the feature in the middle."""
    store, a = run.store, run.summary["hertz"]["a_m"]
    fields = store.fields(in_the_middle(store), ("pressure", "film"))
    middle, X, film = int(np.argmin(np.abs(store.y))), store.x / a, axes.twinx()
    axes.plot(X, fields["pressure"][:, middle] / 1e9, color="#0072B2")
    film.plot(X, fields["film"][:, middle] * 1e6, color="#D55E00", linewidth=1)
    film.set_ylim(0, 3 * run.summary["steady"]["h_c_m"] * 1e6)
    axes.set(title=run.scene.name, xlim=(-1.6, 1.4), ylim=(0, None))
    axes.tick_params(axis="y", colors="#0072B2")
    film.tick_params(axis="y", colors="#D55E00")


def sheet(runs, file):
    """All centrelines on one sheet."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    rows = -(-len(runs) // 3)
    figure, all_axes = plt.subplots(rows, 3, figsize=(10.5, 2.3 * rows), squeeze=False, layout="constrained")
    for axes in all_axes.flat[len(runs):]:
        axes.set_axis_off()
    for axes, run in zip(all_axes.flat, runs):
        centreline(axes, run)
    figure.supxlabel("x / a (flow to the right)", fontsize=9)
    figure.supylabel("pressure, GPa (blue, left); film, µm (orange, right)", fontsize=9)
    figure.savefig(file, dpi=110)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=list(BUILT_INS))
    parser.add_argument("--grid", default="160x40", help="coarser ones do not see the roughness of `rough`")
    parser.add_argument("--steps", type=int)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--out", type=Path)
    given = parser.parse_args()
    print("| " + " | ".join(COLUMNS) + " |", "|---" * len(COLUMNS) + "|", sep="\n")
    with tempfile.TemporaryDirectory() as folder:
        runs = []
        for name in given.scenes:
            runs.append(tehl.run(described(name, given.grid, given.steps), Path(folder, name), threads=given.threads))
            print("| " + " | ".join(row(runs[-1])) + " |", flush=True)
        if given.out:
            sheet(runs, given.out)


if __name__ == "__main__":
    main()
