"""Page of a run with a new fatigue search, with other constants or moments."""

import dataclasses

from tehl_taichi.errors import StoreError
from tehl_taichi.fatigue import judged_surfaces
from tehl_taichi.fatigue.overrides import changed
from tehl_taichi.report import run_page
from tehl_taichi.report.number_text import value_text
from tehl_taichi.report.scene_text import moments
from tehl_taichi.report.verdict import FATIGUE
from tehl_taichi.runs.open_results import RUN, kind, open_run
from tehl_taichi.runs.summary import life, result_warnings
from tehl_taichi.scene import fatigue_limits, left_out, scene_file
from tehl_taichi.scene.feature_wording import position_word
from tehl_taichi.scene.strength import scene_tables
from tehl_taichi.scene.timeline import total_steps
from tehl_taichi.store.sets_of_runs import INSIDE


class RenewedSearch:
    """A new fatigue search of the run in `folder` with these constants (None: those of the run), see
    :func:`tehl_taichi.fatigue`. Raises StoreError for a study or a flank, SceneError.
    """

    def __init__(self, folder, constants):
        if (found := kind(folder)) != RUN:
            given = ", ".join(key for key, value in constants.items() if value is not None)
            raise StoreError(f"{folder} is a {found}; {given} applies to one of its runs, as {folder / INSIDE[found][1]}")
        self.run, self.constants = open_run(folder), constants
        scene = changed(self.run.scene, constants)
        self.scene = scene.replace(**{"fatigue.on": True, "fatigue.source": _source(scene.fatigue, self.run, constants)})

    @property
    def differs(self):
        """[(constant, its text in this search, in the run)] of the constants that differ."""
        pairs = zip(_words(self.scene), _words(self.run.scene))
        return [(what, new, stored) for (what, new), (_, stored) in pairs if new != stored]

    @property
    def is_answered(self):
        """Whether the stored search has these constants."""
        return not self.differs and "fatigue" in self.run.summary

    def page(self, progress=None, threads=None):
        """Search, and make the :class:`tehl_taichi.report.document.Page` of the result. Raises SceneError."""
        found = self.run.fatigue(**self.constants, progress=progress, threads=threads)
        page = run_page.page(SearchedStore(self.run.store, self.scene, found.summaries), found)
        answer = dataclasses.replace(page.answer, question=self._question(), doubts=(*self._doubts(), *page.answer.doubts))
        return dataclasses.replace(page, title=f"{self.scene.name}: report, fatigue with other constants", answer=answer,
                                   about=f"{page.about}, with a new fatigue search")

    def _question(self):
        changes = ", ".join(f"{what} {value}" for what, value, _ in self.differs)
        return f"{FATIGUE.removesuffix('?')}, with {changes}?" if changes else FATIGUE

    def _doubts(self):
        """Sentences about constants of the run, and about an unfinished run."""
        own, store = ", ".join(f"{what} {value}" for what, _, value in self.differs), self.run.store
        if own:
            yield f"The run was stored with other constants: {own}."
        if not store.finished:
            yield (f"The run is not finished: {store.last_step} of {total_steps(store.scene)} time steps are stored, and only "
                   "these count.")


class SearchedStore:
    """Store of a run with scene and summary of another search in place of its own; nothing is written."""

    def __init__(self, store, scene, searches):
        self.store, self.scene = store, scene
        self.attrs = {**store.attrs, "scene_toml": scene_file.dumps(scene)}
        stored = {key: value for key, value in store.summary.items() if key != "life"}
        self.summary = {**stored, "left_out": left_out.parts(scene), **judged_surfaces.parts(searches),
                        **life.part(searches, scene.fatigue)}
        self.warnings = result_warnings.warnings(self, self.summary)

    def __getattr__(self, name):
        return getattr(self.store, name)

    def __len__(self):
        return len(self.store)


def _source(fatigue, run, constants):
    """Source of the constants; that of the run does not hold for other constants."""
    own = run.scene.fatigue
    if constants.get("source") is not None or (fatigue.kappa, fatigue.endurance) == (own.kappa, own.endurance):
        return fatigue.source
    return fatigue_limits.words(fatigue) or type(fatigue)().source


def _words(scene):
    """[(label, text)] of all settings that affect the answer, equal in number and order for every scene."""
    f = scene.fatigue
    return [("κ =", f"{f.kappa:.5g}"), ("σ_eF =", value_text(f.endurance, unit="Pa", digits=5)), ("the criterion", f.criterion),
            *((f"the strength of body {name}", scene_tables.strength_words(f, name)) for name in "ab"),
            ("depths searched:", _depths(f.depths)),
            ("bodies searched:", " and ".join(surface.name for surface in scene.judged)),
            ("moments with the", moments(scene) or f"{position_word(scene)} anywhere"),
            ("shear tractions", "included" if f.shear else "not included"),
            ("thermal stress", "included" if scene.has_thermal_stress else "not included"),
            ("the exponent of the S-N curve", f"{f.exponent:g}" + f" ({f.limit_cycles:g} passages)" * bool(f.exponent)),
            *((f"residual stress along {axis}", f"{getattr(f, f'residual_{axis}{axis}') / 1e6:g} MPa") for axis in "xy")]


def _depths(depths):
    if not depths:
        return "the surface alone"
    points = [] if isinstance(depths, str) else ["all points at "
                                                 + " and ".join(value_text(depth, unit="m") for depth in depths)]
    return ", ".join(["the worst", *points])
