"""Views of stored results: figures and animations (`figures`), files for other tools (`export`).

Only values for pictures are computed here; drawing libraries are imported when they are used. May import: disk, values, scene,
fatigue, march, store.
"""
