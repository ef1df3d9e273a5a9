"""The parts of the documentation that are made from the code when it is built, and how its pages are drawn.

`makers` fills them into the pages: `scene_keys`, `choices`, `commands`, `outputs`, `scenes`, `public_names`, `extending`, one
file each, Markdown out of declarations (with `tables`). `equations` makes MathML of LaTeX, `lists` refuses what Markdown left
as text. May import the package and the commands; only `docs/hooks.py` needs MkDocs.
"""
