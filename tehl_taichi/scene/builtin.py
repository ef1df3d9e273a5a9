"""Built-in scenes."""

from typing import Any

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.description import Scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.named_oils import OILS
from tehl_taichi.scene.sections import Body, Contact, Grid, Operation, Rheology, Thermal
from tehl_taichi.values.checks import missing_file, nearest
from tehl_taichi.values.coerce import shown

# ball of steel on glass, R = 12.7 mm: E' = 117 GPa; oil with alpha = 2.2e-8 1/Pa (spec: the ridge of Venner & Lubrecht)
GLASS = Body(E=75.06e9, nu=0.22, k=1.1, rho=2510.0, c=800.0)
# of the sources behind the ball and the furrow: their curves are of Newtonian oil (the law matters wherever surfaces slip)
NEWTONIAN: dict[str, Any] = dict(thermal=Thermal(on=False), rheology=Rheology(law="newtonian"))
BALL: dict[str, Any] = dict(
    **NEWTONIAN, contact=Contact(kind="point", radius_x=12.7e-3, radius_y=12.7e-3, load=38.35), body_b=GLASS,
    oil=OILS["ridge-test-fluid"], grid=Grid(nx=256, ny=128, x_min=-2.5, x_max=1.5, y_max=2.0))
RIDGE = Feature(shape="ridge", height=0.2e-6, width=128.9e-6)
FURROW = Feature(shape="furrow", height=-2e-6, width=500e-6)
ROUGH = Feature(shape="rough", height=0.15e-6, width=40e-6, extent_x=500e-6, extent_y=500e-6, taper=50e-6)
# marks across rolling
GROUND: dict[str, Any] = dict(shape="ground", height=0.3e-6, width=80e-6, length=480e-6, extent_x=500e-6, taper=60e-6)

# machines and rigs: smooth steel contacts, steady; the bearings are the inner contacts of `tehl bearing 6206 --load 3000
# --speed 3000` and `tehl roller 209-roller --load 4450 --speed 3000`
VG100 = OILS["mineral-vg100"]
POINT_GRID = Grid(nx=128, ny=32)
MTM = Contact(kind="point", radius_x=9.525e-3, radius_y=9.525e-3, hertz_pressure=1e9)
RIG = Contact(kind="point", radius_x=9.525e-3, radius_y=9.525e-3, load=20.0)
BALL_RACE = Contact(kind="elliptic", radius_x=3.776e-3, radius_y=123.8e-3, load=1462.0)
ROLLER_RACE = Contact(radius_x=4.231e-3, load=204e3)
DISCS = Contact(radius_x=20e-3, hertz_pressure=1e9)
CAM = Contact(radius_x=18e-3, load=120e3)

BUILT_INS = {
    "gear": (Scene(), "dedendum of a driving gear: 1.5 um asperity on the slower surface (SRR -0.12), 1.93 GPa"),
    "pitch-line": (Scene(name="pitch-line", operation=Operation(srr=0.0)), "1.5 um asperity in pure rolling"),
    "addendum": (Scene(name="addendum", operation=Operation(srr=0.12)), "1.5 um asperity on the faster surface (SRR +0.12)"),
    "smooth-line": (Scene(name="smooth-line", features=()), "gear contact without an asperity: steady, 1-D"),
    "dent": (Scene(name="dent", features=(Feature(height=-1.5e-6),)), "1.5 um dent instead of the asperity"),
    "touching-asperity": (Scene(name="touching-asperity", features=(Feature(height=3e-6),)),
                          "3 um asperity: the surfaces touch"),
    "rough": (Scene(name="rough", features=(ROUGH,)), "gear contact with a patch of random roughness, rms 0.15 um"),
    "rough-pair": (Scene(name="rough-pair", features=(Feature(seed=1, **GROUND), Feature(seed=2, surface="b", **GROUND)),
                         grid=Grid(nx=192, ny=48)),
                   "two ground flanks, Ra 0.3 um each, marks across rolling (exchange width and length of both: along)"),
    "ball-on-disc": (Scene(name="ball-on-disc", features=(), operation=Operation(u_m=0.01075, srr=0.0), **BALL),
                     "steel ball on glass, 0.54 GPa: steady circular contact, Newtonian oil"),
    "ridge-on-ball": (Scene(name="ridge-on-ball", features=(RIDGE,), operation=Operation(u_m=0.01075, srr=0.0), **BALL),
                      "the ball with a transverse ridge of 0.2 um, pure rolling (SRR -1 or 1: sliding), Newtonian oil"),
    "furrow-line": (Scene(name="furrow-line", contact=Contact(radius_x=14.1e-3, load=1.5708e6), **NEWTONIAN,
                          operation=Operation(u_m=0.97, srr=-1.0), oil=OILS["moes-test-fluid"], features=(FURROW,),
                          grid=Grid(x_min=-3.5, x_max=2.0)),
                    "2 um transverse furrow on the slower surface of a line contact (SRR -1), 2 GPa: 1-D, Newtonian oil "
                    "(ignore its friction)"),
    "mtm": (Scene(name="mtm", contact=MTM, features=(), operation=Operation(u_m=1.0, srr=0.05, temperature=40.0), oil=VG100,
                  grid=Grid(nx=192, ny=48)),
            "traction rig: 3/4 inch steel ball on a steel disc, 1 GPa (base of traction curves)"),
    "ball-on-glass": (Scene(name="ball-on-glass", contact=RIG, body_b=GLASS, features=(), oil=OILS["mineral-vg68"],
                            operation=Operation(u_m=0.3, srr=0.0, temperature=40.0), grid=Grid(nx=192, ny=48)),
                      "optical rig: 3/4 inch steel ball on a glass disc, 20 N, 0.53 GPa, pure rolling (interference colours: "
                      "`tehl plot --interference chromatic`)"),
    "twin-disc": (Scene(name="twin-disc", contact=DISCS, features=(), operation=Operation(u_m=3.0, srr=0.05, temperature=60.0),
                        oil=VG100, grid=Grid(nx=384)),
                  "two steel discs of 80 mm diameter, 1 GPa: 1-D"),
    "ball-bearing": (Scene(name="ball-bearing", contact=BALL_RACE, features=(), oil=VG100, grid=POINT_GRID,
                           operation=Operation(u_m=3.458, srr=-0.0083, temperature=70.0)),
                     "ball and inner ring of a 6206, 3 kN and 3000 1/min: slender ellipse, 2.6 GPa"),
    "roller-bearing": (Scene(name="roller-bearing", contact=ROLLER_RACE, features=(), oil=VG100,
                             operation=Operation(u_m=4.984, srr=0.0, temperature=70.0)),
                       "roller and inner ring of a 209 roller bearing, 4.45 kN and 3000 1/min: pure rolling, 1-D"),
    "cam": (Scene(name="cam", contact=CAM, features=(), operation=Operation(u_m=1.45, srr=1.03, temperature=90.0), oil=VG100,
                  grid=Grid(nx=384)),
            "nose of a cam on a flat follower (SRR 1.03), 0.5 GPa: 1-D"),
}


def scene_or_builtin(scene_):
    """Return a Scene unchanged, or load the built-in scene with this name. Raises SceneError."""
    if isinstance(scene_, Scene):
        return scene_
    if isinstance(scene_, str):
        return scene(scene_)
    raise SceneError(f"{shown(scene_)} is not a scene; tehl_taichi.scene makes one from a built-in name, a TOML file or a "
                     "store")


def scene(name="gear"):
    """Built-in scene with this name. Raises SceneError with the nearest name."""
    if name not in BUILT_INS:
        missing_file(name)
        raise SceneError(f"unknown scene {name!r}{nearest(name, BUILT_INS)}; built in: {', '.join(BUILT_INS)}")
    return BUILT_INS[name][0]


for _scene, _ in BUILT_INS.values():
    _scene.with_user_keys(())
