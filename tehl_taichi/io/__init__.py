"""Files: scene files, stores and what keeps them whole, summaries, warnings about stored results.

May import every room but `study` and the commands. Nothing here computes a film.
"""
