"""Finished results without a solver: a run with temperatures and fatigue, a flank."""

import functools
import hashlib
import pickle
import shutil
import tempfile
from pathlib import Path

import numpy as np
from small_stores import SMALL, shot

from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.scene.scales import Scales

THERMAL = SMALL.replace(**{"thermal.on": True})
EXTRA = {"wall_s": 12.5, "compile_s": 2.5, "steady_error": {"h_c_m": 1e-9, "h_min_m": None},
         "steady_unknown": {"h_min_m": "no coarser grid"}, "steady_parts": {"h_c_m": {"grid": 1e-9, "domain": 0.0}},
         "passage_error": {"a:Fi_max": 0.023, "p_max_Pa": 2e7}, "passage_unknown": {}}


def fatigue(Fi=1.008, below=1.392):
    """Summary of a search."""
    point = {"x_m": 8e-6, "y_m": 0.0, "surface_angle_deg": 57.0, "tau_amp_Pa": 4e8, "sigma_n_max_Pa": 2e7,
             "sigma1_worst_Pa": 6e7}
    found = {"Fi_max": Fi, "findley_stress_max_Pa": Fi * 4e8, **point, "sigma1_max_Pa": 3e8, "kappa_F": 0.3, "sigma_eF_Pa": 4e8,
             "criterion": "findley", "thermal_stress": True, "pit_angles_deg": [18.0, 50.0], "surface": "a",
             "carries_feature": True, "contact_alone": {"Fi_max": 0.9, "findley_stress_max_Pa": 3.6e8, "depth_m": 180e-6,
                                                        "surface_Fi_max": 0.6, "shear_counted": True}}
    if below:
        found["below"] = {"depth_m": 25e-6, "Fi_max": below, "findley_stress_max_Pa": below * 4e8, **point,
                          "searched_m": [3e-6, 3e-4]}
    return found


def maps(columns=9, rows=5, moments=12):
    """{name: (values, dims, units, text)} as a search leaves them."""
    x, y, z = np.linspace(-1e-4, 1e-4, columns), np.linspace(0, 1e-4, rows), np.linspace(1e-6, 3e-4, 6)
    bump = np.exp(-(x[:, None] ** 2 + y**2) / 4e-9)
    stress = 1e8 * np.sin(np.linspace(0, 6, moments))[:, None] * np.arange(1, 7)
    found = {"feature_frame_x": x, "feature_frame_y": y, "Fi": bump, "fatigue_depth": z,
             "findley_stress_under_row": 4e8 * np.exp(-z[:, None] / 1e-4) * bump[:, 0],
             "findley_stress_contact_alone": 3e8 + 0 * z}
    for name in ("worst", "worst_below"):
        found |= {f"{name}_x_a": np.linspace(-1e-3, 1e-3, moments), f"{name}_stress": stress,
                  f"{name}_normal": np.array([0.6, 0.0, 0.8]), f"{name}_circle": np.array([0.0, 0.0, 3e8])}
    return {name: (values, [f"{name}_{n}" for n in range(values.ndim)], "1", name) for name, values in found.items()}


def result(summary, arrays=None):
    """The SearchResult of such a summary and arrays."""
    arrays = maps() if arrays is None else arrays
    return SearchResult.from_arrays({"a": summary}, lambda name: arrays[name][0] if name in arrays else None)


def smooth(step, scene):
    """A snapshot whose fields vary along x and y, largest at the corners."""
    made, s = shot(step, scene), Scales.of(scene)
    sides = (-2.5, 1.5), (0 if scene.symmetric else -1, 1)
    made.x, made.y = (np.linspace(*ends, count) * s.a for ends, count in zip(sides, (made.x.size, made.y.size)))
    X, Y = np.meshgrid(made.x / s.a, made.y / s.a, indexing="ij")
    at = -1.5 + 0.5 * step
    for name in made.fields:
        size = {"pressure": s.p_H, "film": 4e-7}.get(name, 100.0)
        made.fields[name] = size * (1 + 0.1 * step + X**2 + Y**2) if name != "contact" else 0 * X
    made.scalars |= {"h_c_m": 4e-7, "h_min_m": 3e-7 - 1e-8 * step, "p_max_Pa": s.p_H * (1 + 0.1 * step), "residual": 1e-7,
                     "friction_coefficient": 0.05 + 0.001 * step}
    made.feature_x = at * s.a if step else np.nan
    return made


def run(path, scene=THERMAL, entries=5, search=None, found=None, said=("something is doubtful",)):
    """A finished store; search: the summary of its fatigue, or None; found: its maps (default: :func:`maps`);
    said: its warnings. What was made once is copied from then on."""
    if found:
        return _made(path, scene, entries, search, found, said)
    kept = Path(_folder().name) / hashlib.sha256(pickle.dumps((scene, entries, search, said, EXTRA))).hexdigest()[:16]
    if not kept.exists():
        _made(kept, scene, entries, search, None, said)
    return shutil.copytree(kept, path)


@functools.cache
def _folder():
    """Of what was made, for as long as this process lives."""
    return tempfile.TemporaryDirectory(prefix="tehl-made-")


def _made(path, scene, entries, search, found, said):
    from tehl_taichi.runs.summary.summary import summarise
    from tehl_taichi.store.store import Store

    attrs = {"runtime": '{"threads": 2}', "command": "tehl run made-up", "commit": "abc123"}
    with Store.create(path, scene, smooth(0, scene), 50, attrs) as made:
        for step in range(1, entries):
            made.append(smooth(step, scene), shot(step, scene).state)
        summary = summarise(made, EXTRA, {"a": search} if search else None)
        made.finish({**summary, "warnings": list(said)}, (found or maps()) if search else None)
    return path


def flank(folder):
    """A flank of three positions, the last of which did not converge."""
    from tehl_taichi.runs.flank.flank_run import describe, flank_record
    from tehl_taichi.runs.flank.flank_source import flank_source
    from tehl_taichi.runs.flank.line_contacts import scene_at
    from tehl_taichi.runs.flank.outcomes import Outcome
    from tehl_taichi.runs.flank.stored_flank import Flank

    found = flank_source("fzg-c")
    places = found.positions("pinion", None, ("A", "C", "E"))
    scenes = [scene_at(found.scene, {}, found.name, n, place) for n, place in enumerate(places, 1)]
    summaries = [{"steady": {"h_c_m": h, "h_min_m": h / 2, "p_max_Pa": 1e9}, "fatigue": fatigue(Fi, None), "version": "made",
                  "wall_s": 1.0, "warnings": ["same everywhere"]} for h, Fi in ((1e-7, 1.4), (4e-7, 0.7))]
    outcomes = [Outcome(folder / "1.zarr", summaries[0]), Outcome(folder / "2.zarr", summaries[1]),
                Outcome(folder / "3.zarr", reason="step 7 failed")]
    Flank(folder, flank_record(describe(found, folder, "pinion"), places, scenes, outcomes)).write()
    return folder
