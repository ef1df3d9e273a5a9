"""Self-contained HTML page of a run, study, flank, bearing or cam: the verdict first, interactive figures, no network.

`write` chooses the page of a folder; `run_page`, `study_page`, `flank_page`, `bearing_page` and `cam_page` list its parts
(`place_page`: those of flanks and cams), `verdict` writes the answer. `document` renders templates, `embed` packs plotly.js and
numbers into the page. May import: every room but the commands.
"""

from tehl_taichi.report.write import report

__all__ = ["report"]
