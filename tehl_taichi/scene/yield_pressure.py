"""Pressure at which every steel yields, while the simulated bodies stay elastic."""

YIELDS = 4e9  # Pa: under it hardened bearing steel keeps a dent of 1e-4 of a roller's diameter (ISO 76; balls: 4.2 GPa)
STEEL = (f"hardened steel yields above about {YIELDS / 1e9:g} GPa (static limit of roller bearings, ISO 76), softer steel "
         "earlier")
