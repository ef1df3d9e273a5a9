"""Steady films of lines and circles against converged published ones and the film formulas, in Moes' units at L = 10.

python profiles/examples/published_films.py --out docs/published_films.png
python profiles/examples/published_films.py --columns 64        (a coarse look)
"""

import argparse
from pathlib import Path

import numpy as np

import tehl_taichi as tehl
from tehl_taichi.scene.film_formula import moes_line, nijenbanning
from tehl_taichi.scene.scales import Scales

L = 10.0
# {(kind, M): (central, smallest film)}, of the multigrid literature, extrapolated
KNOWN = {("line", 20.0): (4.359, 3.774), ("line", 50.0): (3.793, 3.365), ("line", 100.0): (3.428, 3.087),
         ("line", 200.0): (3.095, 2.821), ("point", 20.0): (4.1706, 2.824), ("point", 200.0): (3.658, 1.738),
         ("point", 1000.0): (3.224, 1.11)}


def contact(kind, M, columns):
    """Newtonian, isothermal, of the test oil that the published films are of; a wide inlet for light loads."""
    light = M <= 20
    changes = {"thermal.on": False, "rheology.law": "newtonian", "oil.name": "moes-test-fluid", "contact.moes_M": M,
               "contact.moes_L": L, "grid.nx": columns if kind == "point" else 2 * columns, "grid.ny": columns // 2,
               "grid.x_min": -4.5 if light else -2.5, "grid.inlet": "starved"}  # as their domains end
    if kind == "point":
        changes |= {"contact.kind": "point", "contact.radius_y": 10.6e-3, "grid.y_max": 3.0 if light else 2.0}
    return tehl.scene("smooth-line").replace(**changes)


def films(scene):
    """[(film, error bar)] of the central and the smallest film in Moes' units."""
    found, s = next(tehl.march(scene)), Scales.of(scene)
    unit = s.R * (2 * scene.oil.eta0 * scene.operation.u_m / (s.E * s.R)) ** 0.5
    return [(found.scalars[key] / unit, (found.error[key] or np.nan) / unit) for key in ("h_c_m", "h_min_m")]


def draw(found, file):
    """Films over M: formula, published, computed with error bars."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, both = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True, layout="constrained")
    for axes, kind, formula in zip(both, ("line", "point"), (moes_line, nijenbanning)):
        loads = [M for name, M in KNOWN if name == kind]
        fine = np.geomspace(min(loads), max(loads))
        axes.plot(fine, [formula(M, L) for M in fine], color="0.6", label="formula, central")
        for n, (words, color) in enumerate((("central", "#0072B2"), ("smallest", "#D55E00"))):
            axes.plot(loads, [KNOWN[kind, M][n] for M in loads], "_", color="black", markersize=18, label="published" * (not n))
            values, bars = zip(*(found[kind, M][n] for M in loads))
            axes.errorbar(loads, values, bars, fmt="o", color=color, markersize=4, capsize=3, label=f"computed, {words}")
        axes.set(title=f"{kind} contact, L = 10", xscale="log", xlabel="M", ylim=(0, None))
    both[0].set_ylabel("film in Moes' units")
    both[1].legend(fontsize=8)
    figure.savefig(file, dpi=110)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--columns", type=int, default=256, help="of the circles; lines take twice as many")
    parser.add_argument("--out", type=Path)
    given = parser.parse_args()
    print("| contact | M | central: published | computed | off by | smallest: published | computed | off by |")
    print("|---" * 8 + "|")
    found = {}
    for (kind, M), known in KNOWN.items():
        found[kind, M] = films(contact(kind, M, given.columns))
        cells = [f"{exact:g} | {value:.3f} ± {bar:.3f} | {100 * (value / exact - 1):+.2f} %"
                 for exact, (value, bar) in zip(known, found[kind, M])]
        print(f"| {kind} | {M:g} | {' | '.join(cells)} |", flush=True)
    if given.out:
        draw(found, given.out)


if __name__ == "__main__":
    main()
