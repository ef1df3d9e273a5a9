"""Numbers of a summary that follow from the steps of a run, and those of its fatigue, one entry each.

Summary, error bars, `tehl show`, reports and the tables of flanks read these entries: a new number is a new entry.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tehl_taichi.march.step_output import Scalar, always, entries, thermal
from tehl_taichi.values.summary_units import without_unit

OVER = {"start": "", "maximum": ", largest", "minimum": ", smallest", "mean": ", mean"}
SPOKEN = {"steady": "steady", "transient": "passage"}  # parts whose numbers have equal names
SHARP, SWAYED = "sharp", "swayed"  # numbers that an unresolved pressure peak leaves unknown, or has a part in


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A number of the summary.

    part, key: its place ("transient", "p_max_Pa"); series: number of a step from which it is computed, "" for fatigue; over:
    reduction, a key of OVER; error: "" (no error bar), "plain", SHARP or SWAYED; positive: by nature; label: its row in `tehl
    show` ("": none); factor, shown: from SI to the printed unit; column, head, form: of the table of a flank ("": none); says:
    long name, if it has no series; exists(scene).
    """

    part: str
    key: str
    series: str = ""
    over: str = "start"
    error: str = ""
    positive: bool = False
    label: str = ""
    factor: float = 1.0
    shown: str = ""
    column: str = ""
    head: str = ""
    form: str = ".3f"
    says: str = ""
    exists: Callable = always

    @property
    def name(self):
        """Long name."""
        return self.says or entries(Scalar)[self.series].says + self._ending

    @property
    def words(self):
        """Short name with its part: "passage h_min", "largest film temperature, steady"."""
        when = SPOKEN.get(self.part)
        return self.label or self.name.removeprefix("fatigue index ") + (f", {when}" if when else "")

    @property
    def _ending(self):
        extreme = entries(Scalar)[self.series].over in ("maximum", "minimum")
        return "" if extreme and not self.key.endswith("_max") else OVER[self.over]

    @property
    def unit(self):
        """SI unit, as in stores."""
        return entries(Scalar)[self.series].unit if self.series else "1"

    def of(self, values, weights):
        """Value from the series of a run, the steady start first; weights: number of steps that every later entry
        represents.
        """
        if self.over == "mean":
            return float(np.average(values[1:], weights=weights))
        return float({"start": lambda: values[0], "maximum": lambda: np.max(values[1:]),
                      "minimum": lambda: np.min(values[1:])}[self.over]())


FILM, PRESSURE = dict(factor=1e6, shown="um"), dict(factor=1e-9, shown="GPa")
HEAT = ("film_max_C", "surface_a_max_C", "surface_b_max_C")
DEGREES = dict(head="film deg C", form=".1f")
ENTRIES = (
    Entry(part="steady", key="h_c_m", series="h_c_m", error="plain", label="steady h_c", **FILM, column="steady_h_c_m",
          head="h_c um"),
    Entry(part="steady", key="h_min_m", series="h_min_m", error="plain", label="steady h_min", **FILM, column="steady_h_min_m",
          head="h_min um"),
    Entry(part="steady", key="p_max_Pa", series="p_max_Pa", error="plain", label="steady p_max", **PRESSURE,
          column="steady_p_max_Pa", head="p_max GPa"),
    Entry(part="steady", key="load_error", series="load_error"), Entry(part="steady", key="mass_error", series="mass_error"),
    Entry(part="steady", key="friction_coefficient", series="friction_coefficient", error="plain",
          label="steady friction coefficient", column="steady_friction", head="friction", form=".4f"),
    Entry(part="steady", key=HEAT[0], series=HEAT[0], error="plain", exists=thermal, column="steady_film_max_C", **DEGREES),
    *(Entry(part="steady", key=key, series=key, error="plain", exists=thermal) for key in HEAT[1:]),
    Entry(part="transient", key="h_min_m", series="h_min_m", over="minimum", error="plain", label="passage h_min", **FILM,
          column="passage_h_min_m", head="h_min um"),
    Entry(part="transient", key="p_max_Pa", series="p_max_Pa", over="maximum", error=SHARP, label="passage p_max", **PRESSURE,
          column="passage_p_max_Pa", head="p_max GPa"),
    Entry(part="transient", key=HEAT[0], series=HEAT[0], over="maximum", error=SHARP, exists=thermal,
          column="passage_film_max_C", **DEGREES),
    *(Entry(part="transient", key=key, series=key, over="maximum", error=SWAYED, exists=thermal) for key in HEAT[1:]),
    Entry(part="transient", key="temperature_change_K", series="temperature_change_K", over="maximum", exists=thermal),
    Entry(part="transient", key="contact_load_fraction_max", series="contact_load_fraction", over="maximum", error=SWAYED,
          positive=True),
    Entry(part="transient", key="contact_area_share_max", series="contact_area_share", over="maximum", error=SWAYED,
          positive=True),
    *(Entry(part="transient", key=f"{key}_max", series=key, over="maximum")
      for key in ("load_error", "mass_error", "residual")),
    Entry(part="transient", key="dt_s", series="dt_s", over="maximum", says="time step"),
    Entry(part="transient", key="friction_coefficient_mean", series="friction_coefficient", over="mean", error=SWAYED,
          label="passage friction coefficient, mean"),
    Entry(part="fatigue.statistics", key="p99", error="plain", says="fatigue index Fi at the surface, 99th percentile",
          column="Fi_p99", head="Fi p99"),
    Entry(part="fatigue.statistics", key="median", error="plain", says="fatigue index Fi at the surface, median",
          column="Fi_median", head="Fi median"),
    Entry(part="fatigue.statistics", key="share_above_1", error="plain", says="share of the surface with Fi > 1", factor=100,
          shown="%", column="share_above_1", head="Fi > 1, %", form=".1f"),
    Entry(part="fatigue.below.statistics", key="p99", error="plain", says="fatigue index Fi below the surface, 99th percentile",
          column="Fi_p99_below", head="p99 below"),
    Entry(part="fatigue", key="Fi_max", error=SHARP, says="fatigue index Fi at the surface, largest", column="Fi_max",
          head="Fi"),
    Entry(part="fatigue.below", key="Fi_max", error=SHARP, says="fatigue index Fi below the surface, largest",
          column="Fi_max_below", head="Fi below"))


def of_part(part, scene=None):
    """Entries of a part of the summary; scene: only those that it has."""
    return [entry for entry in ENTRIES if entry.part == part and (scene is None or entry.exists(scene))]


def of_key(key):
    """The first entry with that key, or None."""
    return next((entry for entry in ENTRIES if entry.key == key), None)


def short_name(key):
    """Name of a number without its unit and its part: h_c for h_c_m, "largest film temperature" for film_max_C."""
    entry = of_key(key)
    if entry and entry.series:
        what, _, over = (entry.label.removeprefix(SPOKEN[entry.part]).strip() or entry.name).partition(", ")
        return f"{over} {what}".strip()
    return without_unit(key)
