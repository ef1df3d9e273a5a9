"""Section of a report on run-in: heights before and after, change of the surface by passage, residual stress."""

from tehl_taichi.report.document import Section, figure_block
from tehl_taichi.report.plots import axis, colour, field_map, line, stack
from tehl_taichi.view.figures import run_in_data
from tehl_taichi.view.figures.palette import GREY, RESULT

ALONG, DEPTH = "x′ (µm)", "depth (µm)"


def section(store):
    """(:class:`Section`,), or () if no steel yielded."""
    if not store.summary.get("run_in", {}).get("plastic_strain_max"):
        return ()
    state = store.run_in
    found = run_in_data.profiles(store.scene, state)
    most = max(one.largest for one in found) / 1e6
    maps = [figure_block(*_residual(one, most)) for one in found]
    return (Section("Run-in", (figure_block(*map(_heights, found), _passages(state.records)), *maps)),)


def _heights(found):
    """Figure of heights along the middle, before and after."""
    lines = [line(found.x * 1e6, found.before * 1e6, "before", GREY, dash="dash"),
             line(found.x * 1e6, found.after * 1e6, "after run-in", colour(0))]
    caption = f"Heights of body {found.body} along the middle, before and after run-in."
    return stack(f"run-in-height-{found.body}", caption, ALONG, [("height (µm)", lines, {})], height=330)


def _passages(records):
    """Figure of the surface change by each passage; the assessed one is grey."""
    numbers = [one["passage"] for one in records]
    bars = {"type": "bar", "x": numbers, "y": [one["surface_change_m"] * 1e9 for one in records], "width": 0.6,
            "showlegend": False, "marker": {"color": [GREY if one["judged"] else colour(0) for one in records]}}
    caption = ("Change of the surface by each passage; grey: the passage that is judged, whose change is not taken over. "
               f"Its new plastic strain is {records[-1]['new_plastic_strain']:.1g}.")
    return stack("run-in-passages", caption, "passage", [("surface change (nm)", [bars], {"rangemode": "tozero"})],
                 x={"tickvals": numbers}, height=330)


def _residual(found, most):
    """Maps of the residual stress along and across, over the depth; most: end of the colours, MPa."""
    out = []
    for words, stress in found.residual.items():
        low, high = stress.min() / 1e6, stress.max() / 1e6
        caption = (f"Residual stress {words} under the middle of body {found.body}: {low:.0f} to {high:.0f} MPa (tension is "
                   "positive).")
        made = field_map(f"run-in-{words[-2:]}-{found.body}", caption, found.x * 1e6, found.depths * 1e6, stress / 1e6, RESULT,
                         "MPa", ALONG, DEPTH, true=False, zmin=-most, zmax=most)
        made.layout["yaxis"] = axis(DEPTH, autorange="reversed")
        out.append(made)
    return out
