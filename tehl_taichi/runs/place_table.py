"""Results at several places as one table of numbers with error bars: angles, positions, rings, cases of a study."""

from dataclasses import dataclass
from pathlib import Path

from tehl_taichi.errors import SceneError
from tehl_taichi.march import quantities
from tehl_taichi.runs.bearing import bearing_table
from tehl_taichi.runs.bearing.ring_contacts import RINGS
from tehl_taichi.runs.cam import cam_columns
from tehl_taichi.runs.compare_labels import flat
from tehl_taichi.runs.flank import flank_columns
from tehl_taichi.runs.flank.line_contacts import where
from tehl_taichi.runs.open_results import BEARING, CAM, FLANK, STUDY
from tehl_taichi.runs.sweep import study_figures, summary_columns
from tehl_taichi.runs.sweep.axis_syntax import DIGITS, all_numbers, short_word, word
from tehl_taichi.runs.sweep.case_records import STATUS
from tehl_taichi.runs.sweep.plan import unit
from tehl_taichi.runs.sweep.study_labels import key_name
from tehl_taichi.runs.sweep.summary_columns import JUDGED
from tehl_taichi.scene.aliases import full_name
from tehl_taichi.scene.gear_pair import GearPair
from tehl_taichi.values.quantity import kinds

SAME_WAY = 7  # decimals (m) to which two positions without a name are one: 0.1 um
ALONG = "x_pl from the pitch point (mm)"
OWN_KEYS = {*kinds(GearPair), "on", "table"}  # of a flank; others follow from these
# label and unit of the columns that are no numbers of a summary with a name
CONTACT = {"R_m": ("reduced radius R'", "mm"), "u_m_m_s": ("entrainment speed", "m/s"), "srr": ("SRR", ""),
           "load_N_m": ("load", "N/mm"), "p_Hertz_Pa": ("Hertz pressure", "GPa"), "Sq_m": ("Sq of both surfaces", "um"),
           "lambda": ("lambda", ""), "lambda_GF": ("specific film lambda_GF", ""),
           "h_min_Ra": ("h_min/Ra", ""), "bulk_C": ("bulk temperature", "deg C"),
           "von_mises_max_Pa": ("largest von Mises stress", "GPa"), "passages": ("passages to initiation", ""),
           "hours": ("hours to initiation", ""), "worse_body": ("worse body", ""),
           "Fi_judged": ("Fi judged", "")}
OF_A_PLACE = ("contact.", "operation.u_", "operation.srr")  # keys of scenes that positions and rings set
WIDER = "grid."  # begins keys that they may set
INDEX = (("Fi_judged",), ("Fi_p99", "Fi_max"), ("Fi_max_below",))
# drawn: the first name of each line that has numbers
OF_POSITIONS = (*INDEX, ("passage_h_min_m", "steady_h_min_m"), ("passage_p_max_Pa", "steady_p_max_Pa"),
                ("passage_film_max_C", "steady_film_max_C"), ("steady_friction",), ("p_Hertz_Pa",))
OF_RINGS = (("Fi_judged",), ("Fi_max",), ("Fi_max_below",), ("passage_h_min_m", "h_min_m", "film_formula_m"), ("p_Hertz_Pa",),
            ("static_safety",), ("friction_coefficient",), ("lambda",))
OF_CASES = ((JUDGED,), ("fatigue_Fi_max",), ("fatigue_below_Fi_max",), ("transient_h_min_m", "steady_h_min_m", "steady_h_c_m"),
            ("transient_p_max_Pa", "steady_p_max_Pa"), ("transient_film_max_C", "steady_film_max_C"),
            ("steady_friction_coefficient",))


@dataclass(frozen=True)
class Place:
    """key: identifies the place across tables; words: its text; x: its number along the axis."""

    key: object
    words: str
    x: float


@dataclass(frozen=True)
class PlaceQuantity:
    """label, unit: printed; factor, form: from SI to the printed number; barred: it has an error bar (which may be unknown)."""

    label: str
    unit: str
    factor: float
    form: str
    barred: bool = False

    @property
    def heading(self):
        """Label and unit."""
        return f"{self.label}, {self.unit}" if self.unit else self.label


@dataclass(frozen=True)
class PlaceTable:
    """Table of one result.

    about: {key: description}; scene: {dotted key: setting} common to its scenes, {} without stores; quantities: {name:
    :class:`PlaceQuantity`}; numbers: {(name, key of a place): (value, error bar or None)}; across: label of the axis; drawn:
    names for the figure, of each line the first with numbers is drawn; ticks: places have names, not numbers, on the axis;
    x_unit: SI unit of the numbers, "" if they are in the unit of the label; failed: texts of the places without a result.
    """

    folder: Path
    title: str
    about: dict
    scene: dict
    places: tuple
    quantities: dict
    numbers: dict
    across: str
    drawn: tuple
    ticks: bool = False
    x_unit: str = ""
    failed: tuple = ()


def place_table(kind, found):
    """The :class:`PlaceTable` of results of this kind (see :func:`tehl_taichi.open`). Raises SceneError."""
    return {FLANK: _of_flank, CAM: _of_cam, BEARING: _of_bearing, STUDY: _of_study}[kind](found)


def _of_flank(flank):
    places = [Place(at.point or round(at.x_pl, SAME_WAY), where(at), at.x_pl * 1e3) for at, *_ in flank.rows]
    about = {"name": flank.name, **flat({key: value for key, value in flank.record["geometry"].items() if key in OWN_KEYS})}
    return _of_positions(flank, places, flank_columns.COLUMNS, about, ALONG)


def _of_cam(cam):
    places = [Place(round(at.angle, 6), at.words, at.angle) for at, *_ in cam.rows]
    about = {key: cam.record[key] for key in ("name", "source")}
    return _of_positions(cam, places, cam_columns.COLUMNS, about, "angle of the cam (degrees)")


def _of_positions(found, places, columns, about, across):
    rows = {place.key: row for place, row in zip(places, found.rows)}
    kept = [one for one in columns if one.name not in ("point", "x_pl_m", "arc_m", "angle_deg")]
    numbers = {(one.name, key): (one.value(*row), one.error(*row)) for one in kept for key, row in rows.items()}
    entries = {entry.column: _of_entry(entry) for entry in quantities.ENTRIES if entry.column}
    known = {one.name: entries.get(one.name) or PlaceQuantity(*CONTACT[one.name], one.factor, one.form, one.barred)
             for one in kept}
    failed = tuple(place.words for place, (*_, summary) in zip(places, found.rows) if summary is None)
    return PlaceTable(found.folder, found.title, about, _shared(found), tuple(places), known, _real(numbers), across,
                      OF_POSITIONS, failed=failed)


def _of_bearing(bearing):
    places = tuple(Place(ring, f"{ring} ring", float(n)) for n, ring in enumerate(RINGS))
    numbers = {(row.name, ring): (row.value(bearing.record, one), row.error(bearing.record, one))
               for row in bearing_table.ROWS for ring, one in bearing.rings.items()}
    known = {row.name: _of_ring_row(row) for row in bearing_table.ROWS}
    about = {key: bearing.record[key] for key in ("name", "oil", "temperature_C", "roughness_Sq_m") if key in bearing.record}
    about |= flat(bearing.record["geometry"])
    failed = tuple(f"{ring} ring" for ring in bearing.failed)
    return PlaceTable(bearing.folder, bearing.title, about, _shared(bearing), places, known, _real(numbers), "", OF_RINGS,
                      ticks=True, failed=failed)


def _of_study(study):
    keys, scene = sorted(study.plan.keys, key=full_name), study.plan.scene
    one = len(keys) == 1 and study_figures.numeric(study, keys[0])
    places = _cases(study, keys, one)
    numbers = {(name, place.key): (float(column[n]), _bar(study, name, n)) for name, column in study.values.items()
               for n, place in enumerate(places) if column[n] == column[n]}
    known = {name: _of_entry(entry) for entry in quantities.ENTRIES
             if entry.column and (name := f"{entry.part}_{entry.key}".replace(".", "_")) in study.values}
    swept = {full_name(key) for key in keys}
    known |= {JUDGED: PlaceQuantity(*CONTACT["Fi_judged"], 1, ".3f", True)} if JUDGED in study.values else {}
    about, settings = {"swept": ", ".join(keys)}, {key: one for key, one in flat(scene.to_dict()).items() if key not in swept}
    across, x_unit = (key_name(keys[0]), unit(scene, keys[0])) if one else ("", "")
    failed = tuple(place.words for place, status in zip(places, study.status) if status != STATUS["converged"])
    return PlaceTable(study.path, f"{scene.name} over {about['swept']}", about, settings, places, known, numbers, across,
                      OF_CASES, not one, x_unit, failed)


def _cases(study, keys, one):
    """Places of a study; one: whether its single key is a number, which then is the axis."""
    changes = [study.plan.changes(n) for n in range(len(study))]
    return tuple(Place(tuple(_same_value(change[key]) for key in keys),
                       ", ".join(f"{key} = {short_word(change[key])}" for key in keys), float(change[keys[0]] if one else n))
                 for n, change in enumerate(changes))


def _same_value(value):
    """Text that equal values share: 5 is 5.0, and a sum of tenths the tenth that it was meant to be."""
    return f"{value:.{DIGITS}g}" if all_numbers([value]) else word(value)


def _bar(study, name, n):
    """Error bar of a case, None if it is not known."""
    column = study.values.get(summary_columns.error_of(name))
    return None if column is None or column[n] != column[n] else float(column[n])


def _of_entry(entry):
    unit = entry.shown or {"degC": "deg C"}.get(entry.unit, "")
    return PlaceQuantity(entry.words, unit, entry.factor, entry.form, bool(entry.error))


def _of_ring_row(row):
    label, _, unit = row.head.partition(", ")
    return PlaceQuantity(label, unit, row.factor, row.form, row.barred)


def _real(numbers):
    """Only the values that are numbers."""
    return {place: (value, error) for place, (value, error) in numbers.items() if isinstance(value, (int, float))}


def _shared(found):
    """Settings common to the scenes of all stored contacts."""
    scenes = [flat(store.scene.to_dict()) for store in found.stores()]
    first = scenes[0] if scenes else {}
    return {key: value for key, value in first.items()
            if key != "name" and not key.startswith(OF_A_PLACE) and all(repr(one.get(key)) == repr(value) for one in scenes)}


def settings(tables):
    """[{key: value}] of the tables, for comparison: settings of scenes that all tables have; keys that positions may set only
    if all tables have them.
    """
    if not all(table.scene for table in tables):
        return [table.about for table in tables]
    common = set.intersection(*(set(table.scene) for table in tables))
    return [{**table.about, **{key: value for key, value in table.scene.items()
                               if key in common or not key.startswith(WIDER)}} for table in tables]


def check_alike(tables):
    """Raise SceneError if studies do not sweep the same keys."""
    for other in tables[1:]:
        first, second = (table.about.get("swept", "") for table in (tables[0], other))
        if [*map(full_name, first.split(", "))] != [*map(full_name, second.split(", "))]:
            raise SceneError(f"{tables[0].folder} is over {first} and {other.folder} over {second}; allowed: studies over the "
                             "same keys")
