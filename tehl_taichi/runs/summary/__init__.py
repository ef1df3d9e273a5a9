"""Summary of a run: the JSON object of `tehl run --json`, its printed rows, the warnings about results.

`summary` assembles it from a store, `summary_rows` prints it (`search_rows`: its fatigue; `summary_row`: one row); the other
files find doubtful results, one subject each.
"""
