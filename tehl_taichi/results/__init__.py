"""What lies in a folder, whichever command wrote it: a run, a study or a flank.

`opened` tells which, and reads it: `tehl_taichi.open`. May import every room before `report`; importing it costs nothing: what
reads files is imported when it is called.
"""
