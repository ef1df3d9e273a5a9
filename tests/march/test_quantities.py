"""Numbers of a summary: their reductions, their units, and where they exist."""

import numpy as np
import pytest

from tehl_taichi.march import quantities
from tehl_taichi.march.quantities import ENTRIES, HEAT, of_part
from tehl_taichi.scene import scene
from tehl_taichi.values.units import in_unit

SERIES, WEIGHTS = np.array([9.0, 3.0, -4.0, 5.0, 1.0]), np.array([1.0, 2.0, 2.0, 1.0])  # the steady start first
IDS = {"ids": lambda entry: f"{entry.part}.{entry.key}"}


@pytest.mark.parametrize("entry", of_part("transient"), **IDS)
def test_a_number_of_a_passage_leaves_out_the_start(entry):
    """It is the largest, except of films and means; each entry counts as many steps as it stands for."""
    wanted = {"h_min_m": -4.0, "friction_coefficient_mean": (3.0 - 8.0 + 10.0 + 1.0) / 6}.get(entry.key, 5.0)
    assert entry.of(SERIES, WEIGHTS) == pytest.approx(wanted)


@pytest.mark.parametrize("entry", of_part("steady"), **IDS)
def test_a_number_of_the_start_is_its_own(entry):
    assert entry.of(SERIES, WEIGHTS) == 9.0 and entry.series == entry.key


@pytest.mark.parametrize("part", ["steady", "transient"])
def test_with_temperatures_each_part_has_those_of_film_and_surfaces(part):
    warm, cold = ({entry.key for entry in of_part(part, one)}
                  for one in (scene("gear"), scene("gear").replace(**{"thermal.on": False})))
    assert cold < warm and warm - cold == {*HEAT} | ({"temperature_change_K"} if part == "transient" else set())
    errors = {entry.key: entry.error for entry in of_part(part) if entry.key in HEAT}
    assert all(errors.values()) and quantities.SHARP not in (errors[HEAT[1]], errors[HEAT[2]])


@pytest.mark.parametrize("entry", [entry for entry in ENTRIES if entry.shown], **IDS)
def test_a_printed_unit_is_that_of_its_factor(entry):
    assert in_unit("", f"{entry.factor!r} {entry.shown}", entry.unit.removeprefix("1")) == pytest.approx(1.0)
    assert not entry.head or entry.shown in entry.head


def test_columns_of_tables_are_of_one_number_each_and_have_a_head():
    columns = [entry.column for entry in ENTRIES if entry.column]
    assert len(set(columns)) == len(columns) and all(bool(entry.head) == bool(entry.column) for entry in ENTRIES)
