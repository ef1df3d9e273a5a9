"""Files: scene files, stores and what keeps them whole, summaries, warnings about stored results, figures.

May import every room but the commands. Nothing here computes a film.
"""
