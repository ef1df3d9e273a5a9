"""Description of each built-in scene, from the scene itself."""

from handbook.tables import code, plain, sentence
from tehl_taichi.scene import BUILT_INS
from tehl_taichi.scene.scales import Scales


def text():
    """A section a scene: its sentence, its numbers, what it leaves out, what it warns of."""
    return "\n\n".join(section(name, scene, says) for name, (scene, says) in BUILT_INS.items())


def section(name, scene, says):
    lines = [f"## {code(name)} {{ #{name} }}", plain(sentence(says)), numbers(scene),
             "\n".join(f"* left out: {plain(what)}" for what in scene.left_out()),
             "\n".join(f"* warning: {plain(sentence)}" for sentence in scene.warnings())]
    return "\n\n".join(filter(None, lines))


def numbers(scene):
    """Load, size, motion, oil, feature in a line."""
    s, o, g = Scales.of(scene), scene.operation, scene.grid
    features = ", ".join(f"{code(f.shape)} {f.height * 1e6:g} µm" for f in scene.features) or "none"
    return (f"Load {scene.load:g} {'N/m' if s.line else 'N'} on R′ = {s.R * 1e3:g} mm: half-width {s.a * 1e3:.3g} mm, "
            f"{s.p_H / 1e9:.3g} GPa; u_m = {o.u_m:g} m/s, SRR = {o.srr:g}, inlet {o.temperature:g} °C; oil "
            f"{code(scene.oil.name)}, {code(scene.rheology.law)}; feature: {features}; grid {g.nx} x {g.ny} cells. "
            f"`tehl run {scene.name}`")
