"""Tables and panels name the number that they show, in the unit by which it is multiplied."""

import re

import pytest
from tehl_cli import live_curves, sweep_display, tables, traction_command

from tehl_taichi.report import passage_plots
from tehl_taichi.view.figures import frames, line_figures, zoom_maps

FACTORS = {"um": 1e6, "µm": 1e6, "GPa": 1e-9}  # of printed units, from SI
LENGTH, STRESS, HEAT = " \\(?(um|µm)\\)?$", " \\(?(GPa)\\)?$", " \\(?(deg C|°C)\\)?$"
# {end of a key: what its label matches}
MEANT = {"h_min_m": f"(?:h_min|smallest film){LENGTH}", "h_c_m": f"h_c{LENGTH}", "p_max_Pa": f"(?:p_max|pressure){STRESS}",
         "film_max_C": f"(?:film|temperature){HEAT}", "surface_a_max_C": f"surface a .*{HEAT}", "pressure": f"pressure{STRESS}",
         "surface_b_max_C": f"surface b .*{HEAT}", "film": f"film{LENGTH}", "temperature_mid": f"film.*{HEAT}",
         "temperature_a": f"surface a.*{HEAT}", "temperature_b": f"surface b.*{HEAT}", "load_error": "load()",
         "mass_error": "mass()", "contact_load_fraction": "load on solid()", "judged_Fi": "Fi judged()",
         "newton": "Newton()", "cycles": "Krylov()"}
HEADS = [*((key, head, factor) for key, head, factor, _ in tables.HISTORY), *traction_command.COLUMNS, *sweep_display.SHOWN,
         *sweep_display.STEADY]
CURVES = [(key, f"{title} ({unit})", factor) for key, title, factor, unit, _ in live_curves.SHOWN]
MAPS = [(field, label, factor) for field, factor, label, _ in frames.SHOWN.values()]
WINDOWS = [(key, f"{title} ({unit})", factor) for key, (title, factor, unit, _) in zoom_maps.SHOWN.items()]
PANELS = [(key, f"{text} {label}", factor) for label, factor, lines in (*passage_plots.FIELDS, *passage_plots.HISTORIES)
          for key, text in lines.items()]
FRAMES = [(key, f"{text or ''} {label}", factor) for label, factor, lines in frames.PANELS.values()
          for key, (_, text) in lines.items()]
KINDS = [(key, f"{text} (°C)", 1) for key, text, _ in line_figures.SURFACES]


@pytest.mark.parametrize("key, label, factor", [*HEADS, *CURVES, *MAPS, *WINDOWS, *PANELS, *FRAMES, *KINDS])
def test_a_label_has_the_word_and_the_unit_of_its_number(key, label, factor):
    found = re.search(next((meant for end, meant in MEANT.items() if key.endswith(end)), f"({key.partition('_')[0]})"), label)
    assert found and FACTORS.get(found[1], 1) == factor


def test_keys_of_traction_have_the_units_of_their_heads():
    said = {"C": "deg C", "N_m": "N/m", "m_s": "m/s", "N": "N", "Pa": "Pa"}
    for key, head in traction_command.KEYS.items():
        assert key == "srr" or head.endswith(next(unit for end, unit in said.items() if key.endswith(f"_{end}"))), key
