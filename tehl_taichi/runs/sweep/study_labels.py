"""Labels of swept keys and result columns of a study, with printed units."""

from tehl_taichi.march import quantities
from tehl_taichi.runs.sweep.plan import unit
from tehl_taichi.runs.sweep.summary_columns import unit_of
from tehl_taichi.scene.aliases import full_name
from tehl_taichi.values.digits import printed_unit

# of keys that are swept often; others keep their name
KEYS = {"operation.srr": "slide-roll ratio", "operation.u_m": "mean speed", "operation.temperature": "inlet temperature",
        "operation.u_a": "speed of surface a", "operation.u_b": "speed of surface b", "contact.load": "load",
        "contact.hertz_pressure": "Hertz pressure", "contact.radius_x": "reduced radius along x",
        "contact.radius_y": "reduced radius across", "fatigue.kappa": "κ", "fatigue.endurance": "fatigue limit",
        "oil.nu_40": "kinematic viscosity at 40 °C", "oil.alpha_40": "pressure coefficient at 40 °C",
        "grid.nx": "cells along x", "grid.ny": "cells across"}
READ = {"degC": "°C", "deg C": "°C", "deg": "°", "degree": "°", "1": ""}


def key_name(key):
    """Name of a swept key: "feature height" for feature.height; the key itself if it has no name."""
    full = full_name(key)
    section, _, rest = full.partition(".")
    number, _, name = rest.partition(".")
    if section == "feature" and name:
        return f"feature {name}" if number == "0" else f"feature {number}, {name}"
    return KEYS.get(full, key)


def key_unit(scene, key):
    """Unit of the values of a key, as they are given: "N/m", "" for a pure number or a word."""
    found = unit(scene, key)
    return "" if found == "1" else found


def column_name(name):
    """Name of a column: "passage h_min" for transient_h_min_m; the words of the column if it has no name."""
    entry = next((one for one in quantities.ENTRIES if f"{one.part}_{one.key}".replace(".", "_") == name), None)
    return entry.words if entry and (entry.label or entry.says or entry.series) else \
        name.removesuffix(f"_{unit_of(name)}").replace("_", " ")


def with_unit(text, unit_):
    """Text with its unit, such as 'load (N/mm)'; the text alone without a unit."""
    shown = READ.get(unit_, unit_)
    return f"{text} ({shown})" if shown else text


def name_and_unit(label):
    """(name, unit) of a label, such as 'load', 'N/mm' of 'load (N/mm)'; unit "" without one."""
    name, bracket, shown = label.removesuffix(")").rpartition(" (")
    return (name, shown) if bracket and label.endswith(")") else (label, "")


def label_with_value(label, word):
    """Text such as 'load 3 N/mm' from the label 'load (N/mm)' and the text of a value."""
    return " ".join(filter(None, (name_and_unit(label)[0], word, name_and_unit(label)[1])))


def of_key(scene, key, size):
    """(factor, label) of a key whose SI values are about this size."""
    factor, shown = printed_unit(unit(scene, key), size)
    return factor, with_unit(key_name(key), shown)


def of_column(name, size):
    """(factor, label) of a column of the table whose SI values are about this size."""
    factor, shown = printed_unit(unit_of(name), size)
    return factor, with_unit(column_name(name), shown)
