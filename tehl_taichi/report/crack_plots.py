"""Cracks of a run, stored by `tehl crack --keep`: the answer, the section below the feature, K over the passage."""

import numpy as np

from tehl_taichi.report.document import PageBlock, Section, facts, figure_block, sentences
from tehl_taichi.report.number_text import value_text
from tehl_taichi.report.plots import colour, field_map, line, stack
from tehl_taichi.store.crack_file import load
from tehl_taichi.view.figures.crack_figures import BAND, SHOWN, along
from tehl_taichi.view.figures.palette import GREY, TENSION

POSITION = "position of the feature x / a"


def section(store):
    """(:class:`Section`,), or () without a stored crack result of this run. Raises StoreError."""
    found = load(store)
    if not found:
        return ()
    summary, shown = found["summary"], found["drawn"]
    doubts = [doubt for side in summary["sides"].values() for doubt in side.get("doubts", [])]
    return (Section("Cracks", (PageBlock("text", {"sentences": verdict(summary)}), facts(_options(summary)),
                               sentences(doubts, "Doubtful"), figure_block(_map(summary, shown)),
                               figure_block(*_histories(shown)))),)


def verdict(summary):
    """One sentence per side: tension, direction of the crack, its driving load, reason of its end."""
    return [_sentences(name, side, summary["pit_angles_deg"]) for name, side in summary["sides"].items()]


def _sentences(name, side, pits):
    if not side["opens"]:
        return f"There is no crack on the {name} side: {side['why']}."
    error = side.get("error_at_last_length", {}).get("K_I_max")
    begins = f"On the {name} side the surface tension reaches {value_text(side['sigma1_surface_Pa'], unit='Pa')}"
    drives = f"K_I reaches {side['K_I_max'] / 1e6:.2g} MPa√m" + (
        f" (at the last length ± {error / 1e6:.1g}, by twice as many elements)" if error is not None else "")
    where = _angles(side["path"], pits) if "length_m" in side else ""
    return f"{begins}; {drives}{where}; the crack stops because {side['why']}."


def _angles(path, pits):
    """Text of the crack's lean, and its angle at the largest depth."""
    chords = [(depth, angle) for depth, angle in path["chord_deg_at_um"].items() if angle is not None]
    at = f" at {chords[-1][1]:.0f}° to the surface at {chords[-1][0]} µm depth" if chords else ""
    return f"; the crack leans {path['lean']}{at} (pits: with rolling, {pits[0]:g} to {pits[1]:g}°)"


def _options(summary):
    """Loads and options of the cracks as text."""
    oil = summary["oil_is"] + (f", {summary['oil_share']:g} of it" if summary["oil_share"] not in (None, 1) else "")
    threshold = "none" if summary["threshold"] is None else f"{summary['threshold'] / 1e6:g} MPa√m"
    body = f"{summary.get('surface', 'a')} ({'with' if summary.get('carries_feature', True) else 'without'} the feature)"
    return [("body", body), ("inside", oil), ("friction of closed faces", f"{summary['face_friction']:g}"),
            ("threshold of K_I", threshold), ("thermal stress", "counts" if summary["thermal_stress"] else "does not count")]


def _map(summary, shown):
    """Map of the largest tension of the passage, with trajectories, cracks and the band of the pits."""
    x, depth, tension = (np.array(shown[key]) for key in ("x", "depth", "tension"))
    marked = [one for n, (name, side) in enumerate(shown["sides"].items())
              for one in (*_band(side, summary["pit_angles_deg"], n == 0), *_lines(name, side, n))]
    caption = (f"Section of body {summary.get('surface', 'a')}: largest tension of the passage, σ₁ trajectories (dashed), "
               "crack paths; grey: the pits of the thesis.")
    figure = field_map("cracks", caption, x * 1e6, depth * 1e6, tension / 1e6, TENSION, "MPa", along(summary),
                       "below the surface (µm)", marked, height=440, zmin=0.0, zmax=SHOWN / 1e6)
    figure.layout["yaxis"]["range"], figure.layout["xaxis"]["range"] = [1e6 * depth[-1], 0.0], [1e6 * x[0], 1e6 * x[-1]]
    return figure


def _band(side, pits, in_legend):
    """Band of the pits, which lean with rolling from the mouth."""
    mouth, band = 1e6 * side["path"][0][0], 1e6 * BAND
    ends = band * np.tan(np.radians(pits))
    return [line([mouth, mouth - band, mouth - band, mouth], [0, *ends, 0], f"pits, {pits[0]:g} to {pits[1]:g}°", GREY,
                 in_legend=in_legend, fill="toself", opacity=0.4)]


def _lines(name, side, n):
    along, path = (1e6 * np.array(side[key]).T for key in ("trajectory", "path"))
    return (line(along[0], along[1], f"{name}: normal to the largest tension", colour(n), dash="dash"),
            line(path[0], path[1], f"{name}: crack", colour(n)))


def _histories(shown):
    """Figures of K at the first and last length over the feature's position, one for each side with a crack."""
    return [_history(name, side["K"], shown["position"]) for name, side in shown["sides"].items() if side["K"]]


def _history(name, cracks, position):
    panels: list[tuple] = []
    for panel, key in enumerate(("K_I", "K_II"), 1):
        lines = [line(position, 1e-6 * np.array(crack[key]), f"at {1e6 * crack['length']:.0f} µm", colour(n), panel,
                      in_legend=panel == 1) for n, crack in enumerate(cracks)]
        panels.append((f"{key} (MPa√m)", lines, {}))
    caption = f"Stress intensities of the crack on the {name} side while the feature passes."
    return stack(f"K-{name}", caption, POSITION, panels, height=440)
