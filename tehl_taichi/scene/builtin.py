"""Built-in scenes."""

from tehl_taichi.scene.checks import SceneError, nearest
from tehl_taichi.scene.parts import Feature, Operation
from tehl_taichi.scene.whole import Scene

BUILT_INS = {
    "gear": (Scene(), "dedendum of a driving gear: 1.5 um asperity on the slower surface (SRR -0.12), 1.93 GPa"),
    "pitch-line": (Scene(name="pitch-line", operation=Operation(srr=0.0)), "the same asperity in pure rolling"),
    "addendum": (Scene(name="addendum", operation=Operation(srr=0.12)), "the asperity on the faster surface (SRR +0.12)"),
    "smooth-line": (Scene(name="smooth-line", features=()), "the gear contact without an asperity: steady, 1-D"),
    "dent": (Scene(name="dent", features=(Feature(height=-1.5e-6),)), "a 1.5 um dent in place of the asperity"),
    "touching-asperity": (Scene(name="touching-asperity", features=(Feature(height=3e-6),)),
                          "a 3 um asperity: the surfaces touch"),
}


def scene(name="gear"):
    """The built-in scene of that name. Raises SceneError with the nearest name."""
    if name not in BUILT_INS:
        raise SceneError(f"unknown scene {name!r}{nearest(name, BUILT_INS)}; built in: {', '.join(BUILT_INS)}")
    return BUILT_INS[name][0]
