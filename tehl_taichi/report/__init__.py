"""One self-contained HTML page of a run, a study or a flank, to send to a colleague: answer first, figures to zoom, no network.

`written` decides what lies in a folder and writes; `run_page`, `study_page`, `flank_page` say what stands on a page, from
`verdict`, `scene_words`, tables and plots; `document` renders it with `templates/`, a file for each kind of part; `packed`
keeps plotly.js and the numbers small. May import every room but the commands; jinja2 and plotly are imported where they are
used.
"""

from tehl_taichi.report.written import report

__all__ = ["report"]
