"""A dry crack: nothing acts on its faces."""

import numpy as np

from tehl_taichi.crack.filling import Filling
from tehl_taichi.crack.fillings import check_value
from tehl_taichi.values.registry import Checked

DRY: Filling = Filling(
    name="dry", says="no oil in the crack", source="Hannes & Alfredsson 2011 (dry asperity)",
    inside=lambda wet: wet.under(np.zeros_like(wet.mouth)),
    checked=(Checked("normal edge crack, tension 1, whatever the film has (Tada, Paris & Irwin)", 1.1215,
                     lambda: check_value(DRY, mouth=3.0), 1e-3),))
