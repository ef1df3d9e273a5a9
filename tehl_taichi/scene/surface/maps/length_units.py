"""Units of heights in files."""

UNITS = {"nm": 1e-9, "um": 1e-6, "mm": 1e-3, "m": 1.0}  # of the heights in a file, m
MICRO = str.maketrans({"\u00b5": "u", "\u03bc": "u"})  # micro sign and Greek mu, as in µm
