"""Stored bearing: a folder with loads, both contacts and their summaries, table, figure."""

from tehl_taichi.runs import machine_life
from tehl_taichi.runs.bearing import bearing_table
from tehl_taichi.runs.bearing.bearing_source import as_given
from tehl_taichi.runs.bearing.ring_contacts import RINGS
from tehl_taichi.runs.contact_set import ContactSet
from tehl_taichi.values.coded_warning import summary_for_reader


class Bearing(ContactSet):
    """Results of a rolling bearing: :func:`tehl_taichi.bearing` and :func:`tehl_taichi.open` give one.

    Attributes
    ----------
    folder : pathlib.Path
        Its folder.
    record : dict
        The JSON object of `tehl bearing --json`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> ring = {"p_Hertz_Pa": 2e9, "summary": None}
    >>> tehl.Bearing("b", {"name": "6206", "inner": ring, "outer": ring})
    <tehl.Bearing 6206: p_H 2.00 GPa inner, 2.00 GPa outer, b>
    """

    KIND = "bearing"
    TABLES = ("geometry",)

    @property
    def rings(self) -> dict:
        """{"inner", "outer": record of its contact, with its summary}."""
        return {ring: {**one, "summary": summary_for_reader(one["summary"])} for ring in RINGS for one in (self.record[ring],)}

    @property
    def _contacts(self):
        return list(self.rings.values())

    @property
    def failed(self) -> dict:
        """{ring: reason} of the rings whose run has no result."""
        return {ring: one["reason"] for ring, one in self.rings.items() if one["summary"] is None and one["reason"]}

    @property
    def title(self) -> str:
        """One-line description of the bearing."""
        one = self.record["geometry"]
        axial = f", {one['axial']:g} N axial" if one["axial"] else ""
        name = as_given(self.name, self.record.get("changed", ()))
        return f"{name}: {one['load']:g} N radial{axial}, {one['speed']:g} 1/min, {self.record['oil']} at " \
               f"{self.record['temperature_C']:g} deg C"

    def with_ring(self, ring, outcome):
        """Copy with the outcome of the run of a ring."""
        done = {**self.record[ring], "converged": outcome.summary is not None, "reason": outcome.reason,
                "summary": machine_life.with_hours(outcome.summary, machine_life.of_ring(self.record, self.record[ring]))}
        return Bearing(self.folder, {**self.record, ring: done})

    def _csv(self):
        return bearing_table.csv_text(self)

    def _drawn(self, page):
        from tehl_taichi.runs.bearing import bearing_figure

        return bearing_figure.drawn(page, self)

    def __repr__(self):
        pressures = ", ".join(f"{one['p_Hertz_Pa'] / 1e9:.2f} GPa {ring}" for ring, one in self.rings.items())
        return f"<tehl.Bearing {self.name}: p_H {pressures}, {self.folder}>"
