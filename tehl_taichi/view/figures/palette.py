"""Palette: the colours of every figure, animation and report, distinguishable for colour-blind readers.

Lines: Okabe & Ito 2008, Color Universal Design. Maps: with monotonic lightness, so that they can be read in grey; matplotlib
and plotly both know them by these names.
"""

BLUE, VERMILLION, GREEN, PURPLE = "#0072b2", "#d55e00", "#009e73", "#cc79a7"
ORANGE, SKY, BLACK, YELLOW = "#e69f00", "#56b4e9", "#000000", "#f0e442"
LINES = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY, BLACK, YELLOW)  # in the order in which they are used

GREY = "#707070"   # what others are compared with: a steady start, a contact without its feature
RULE = "#c8c8c8"   # lines that only guide the eye
SHADE = "#ededed"  # a part of the page that is marked off, or has no value
MARK = SKY         # a place on a dark map
LIMIT, RIM = "#ffffff", "#000000"  # a line on a map, and its rim: one of them is seen wherever it runs
BARS = {"capsize": 2, "elinewidth": 0.8}  # of errors

PRESSURE = TEMPERATURE = INDEX = "inferno"
FILM = RESULT = "viridis"  # RESULT: of a study
HEIGHT = "cividis"         # of a surface
TENSION = "Oranges"        # light where there is none: lines are drawn on it
