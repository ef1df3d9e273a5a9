"""Displacement of each surface since X = 0, where all features are at their positions x."""

from tehl_taichi.march.step_output import Scalar, passing

SOURCE = "its speed over that of the clock times X (scene/moving_surfaces)"
A, B = (Scalar(name=f"displacement_{name}_m", unit="m", says=f"displacement of surface {name} since X = 0", over="point",
               exists=passing, source=SOURCE, of=lambda s, n=n: s.displacements[n], by_hand=moved)
        for n, (name, moved) in enumerate({"a": -1.5e-4, "b": -1.8e-4}.items()))
