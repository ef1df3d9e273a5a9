"""Results of traction curves: one row per case, grouped to curves."""

from os import PathLike
from pathlib import Path

from tehl_taichi.runs.sweep.study_table import Study
from tehl_taichi.values.coded_warning import counted
from tehl_taichi.values.digits import number_of, part_of, printed_unit
from tehl_taichi.values.summary_values import error_of, value_at

TEMPERATURE, SPEED, SRR, LOAD, PRESSURE = "temperature", "speed", "srr", "load", "hertz_pressure"
ALONG = (SRR, SPEED, LOAD, PRESSURE, TEMPERATURE)  # of keys with several values the first is that along the curves
RESULTS = ("friction_coefficient", "h_c_m", "h_min_m", "film_max_C")
# {key of the plan: (key of a row, name, unit)}
AXES = {SRR: ("srr", "slide-roll ratio SRR", ""), SPEED: ("u_m_m_s", "mean speed", "m/s"),
        TEMPERATURE: ("temperature_C", "inlet temperature", "°C"), LOAD: ("load_N", "load", "N"),
        PRESSURE: ("p_Hertz_Pa", "Hertz pressure", "Pa")}
LINE_LOAD = ("load_N_m", "load per length", "N/m")


def axis(plan, key):
    """(key of a row, name, unit) of a swept key."""
    return LINE_LOAD if key == LOAD and plan.scene.load_unit == LINE_LOAD[2] else AXES[key]


class Traction:
    """Friction, film and temperature over slip; :func:`tehl_taichi.traction` returns one.

    Attributes
    ----------
    study : Study
          The sweep behind it, with the summary of every case.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> line = tehl.scene("smooth-line").replace(**{"grid.nx": 32})
    >>> found = tehl.traction(line, srr=[0.1], path="t.zarr", changes={"thermal.on": False}, workers=1)
    >>> found, f"{found.rows[0]['friction_coefficient']:.2f}"
    (<tehl.Traction smooth-line: 1 of 1 case, t.zarr>, '0.08')
    """

    def __init__(self, study: Study) -> None:
        self.study = study

    @property
    def rows(self) -> list:
        """One dictionary per case: srr, temperature_C, u_m_m_s (and load_N, load_N_m or p_Hertz_Pa if swept),
        friction_coefficient, h_c_m, h_min_m, film_max_C, their error bars in "error", converged, reason; numbers are None for a
        case without a result.
        """
        found = {record["case"]: record for record in self.study.results()}
        return [self._row(number, found.get(number)) for number in range(len(self.study))]

    def _row(self, number, record):
        plan, record = self.study.plan, record or {"summary": None, "status": "waiting", "reason": "it has not run yet"}
        changes, o = plan.changes(number), plan.scene.operation
        own = {"srr": float(changes.get(SRR, o.srr)), "temperature_C": float(changes.get(TEMPERATURE, o.temperature)),
               "u_m_m_s": float(changes.get(SPEED, o.u_m)),
               **{axis(plan, key)[0]: float(changes[key]) for key in (LOAD, PRESSURE) if key in changes}}
        results = {key: value_at(record["summary"], "steady", key) for key in RESULTS}
        error = {key: error_of(record["summary"], "steady", key) for key in RESULTS}
        return {**own, **results, "error": error, "converged": record["status"] == "converged", "reason": record["reason"]}

    @property
    def failed(self) -> list:
        """The rows without a result."""
        return [row for row in self.rows if not row["converged"]]

    @property
    def across(self) -> str:
        """Key along the curves: srr, or the only key with several values."""
        several = [key for key in ALONG if key in self.study.plan.keys and len(self.study.plan.coordinate(key)[1]) > 1]
        return several[0] if several else SRR

    @property
    def curves(self) -> dict:
        """{label: rows} of the curves over :attr:`across`."""
        others = [key for key in self.study.plan.keys if key != self.across]
        out: dict[str, list] = {}
        for row in self.rows:
            label = ", ".join(self._words(key, row) for key in others)
            out.setdefault(label, []).append(row)
        return out

    def _words(self, key, row):
        """Legend text of a key's value in a row."""
        name, _, unit = axis(self.study.plan, key)
        factor, shown = printed_unit(unit, abs(row[name]))
        return f"SRR {row['srr']:g}" if key == SRR else f"{row[name] * factor:g} {shown}"

    @property
    def warnings(self) -> list:
        """Keys without effect, and the :attr:`warnings_of_cases`."""
        return [*self.study.plan.doubts(), *self.warnings_of_cases]

    @property
    def warnings_of_cases(self) -> list:
        """Further warnings of the cases: the first of every kind, with the number of its cases."""
        results = ((record["case"], record["summary"]) for record in self.study.results())
        return counted(results, number_of(len(self.study), "case"), leave=self.study.plan.doubts())

    def to_dict(self) -> dict:
        """The JSON object of `tehl traction --json`."""
        return {"scene": self.study.plan.scene.name, "study": str(self.study.path), "table": str(self.study.table),
                "rows": self.rows}

    def plot(self, folder: str | PathLike | None = None, dpi: int = 160, format: str = "png", width: float = 17.0,
             force: bool = False) -> Path:
        """Write the figure traction.png into `folder` (default: beside the study); returns its path.

        dpi, format, width, force: as :meth:`Run.plot`. Raises SceneError; StoreError without matplotlib, or if a file is in the
        way.
        """
        from tehl_taichi.runs.traction import traction_figure
        from tehl_taichi.view.figures.figure_style import FigureStyle, default_folder

        page = FigureStyle(format, dpi, width, force)
        (path,) = page.write(folder or default_folder(self.study.path), {"traction": lambda: traction_figure.drawn(page, self)})
        return path

    def __repr__(self):
        done = len(self.study) - len(self.failed)
        return f"<tehl.Traction {self.study.plan.scene.name}: {part_of(done, len(self.study), 'case')}, {self.study.path}>"
