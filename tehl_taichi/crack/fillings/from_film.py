"""The film's pressure at the mouth acts at once in the whole crack: an upper bound of the effect of the oil."""

from tehl_taichi.crack.filling import Filling
from tehl_taichi.crack.fillings import check_value
from tehl_taichi.values.registry import Checked

FROM_FILM: Filling = Filling(
    name="film", says="film pressure above the mouth acts everywhere in the crack: an upper bound", source="Way 1935",
    inside=lambda wet: wet.under(wet.share * wet.mouth),
    checked=(Checked("normal edge crack, tension 1 and pressure 3: four times that of the tension", 4 * 1.1215,
                     lambda: check_value(FROM_FILM, mouth=3.0), 1e-3),))
