"""Parts that a scene does not need and that are not computed, each with its reason."""

from tehl_taichi.scene import film_formula, run_in
from tehl_taichi.scene.timeline import cut_at
from tehl_taichi.values.coded_text import CodedText, Option, options_of


def parts(scene, cut=True):
    """Sentences of :meth:`Scene.left_out`, with the options of the command line, as stores keep them."""
    return [*_fields(scene), *_march(scene, cut), *_steel(scene), *_shear(scene)]


def _fields(scene):
    if scene.isothermal:
        why = "isothermal film" if scene.thermal.on is False else "no slip" if scene.operation.srr == 0 else "a Moes pair"
        option = Option("; --thermal computes them", "")
        text = f"energy equation and temperatures ({why}{option}{film_formula.heat_words(scene)})"
        yield CodedText(text, "isothermal", options_of(option))
    if scene.isothermal and scene.film_oil.expansion == "thermal" and scene.oil.expands:
        yield "thermal expansion of the oil (isothermal film; oil.expansion = 'always' includes it)"
    if scene.one_dimensional:
        yield "y direction (nothing varies along y in this line contact)"
    elif scene.symmetric:
        yield "half of the domain (symmetric in y)"


def _march(scene, cut):
    if not scene.transient:
        yield "march in time (steady)" if scene.features else "march in time (no feature)"
    elif cut and (end := cut_at(scene)) is not None:
        option = Option("; `tehl resume` continues", "")
        text = f"rest of the passage (cut at {end:.2f} a by time.steps or time.x_end{option})"
        yield CodedText(text, "cut", options_of(option))


def _steel(scene):
    if not scene.has_fatigue:
        yield scene.without_fatigue
    yield from (f"run-in of body {name} ({why})" for name, why in run_in.elastic_bodies(scene).items())


def _shear(scene):
    if scene.operation.u_s == 0:
        yield "sliding friction (SRR = 0)"
    if not scene.rheology.thins:
        yield f"shear law of the film (rheology.law = {scene.rheology.law!r})"
