"""Views of stored results: figures and animations (`figures`), files for other tools (`export`).

Nothing is computed here but what a picture needs; drawing libraries are imported when they are used.
May import: disk, values, scene, fatigue, march, store.
"""
