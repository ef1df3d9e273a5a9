"""Everything a scene can choose from, from the registries: the tables of `tehl laws`, `oils`, `steels` and `scenes`, and what
each entry is checked against."""

import math

from handbook.tables import code, plain, table
from tehl_taichi.crack.fillings import FILLINGS
from tehl_taichi.laws.choices import ALONE, CHOICES
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.laws.hardening import HARDENINGS
from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.scene.feature import SHAPES, USED_BY
from tehl_taichi.scene.named_oils import NAMED
from tehl_taichi.scene.named_steels import STEELS


def text():
    """All registries, one after the other."""
    return "\n\n".join([*(laws(f"Choices of {code(key)}", registry) for key, registry in CHOICES.items()),
                        laws("Laws without a choice", ALONE), shapes(), criteria(), relations(), hardenings(), fillings(),
                        oils(), steels()])


def laws(title, registry):
    """A law a row, with its numbers, the range that it was measured in, its source and what it is checked against."""
    rows = ((code(law.name), plain(law.says), ", ".join(map(code, law.numbers)), plain(_range(law)), plain(law.source),
             _checked(law)) for law in registry.values())
    return f"## {title}\n\n" + table(("name", "law", "numbers", "measured up to", "source", "checked against"), rows)


def _range(law):
    limits = (("GPa", law.most_p / 1e9), ("°C", law.most_Gamma))
    return ", ".join(f"{most:g} {unit}" for unit, most in limits if most < math.inf)


def _checked(entry):
    return "; ".join(plain(known.where) for known in entry.checked)


def shapes():
    """A shape of features a row."""
    rows = ((code(shape.name), plain(shape.says), ", ".join(code(key) for key, users in USED_BY.items() if shape.name in users),
             plain(shape.source), _checked(shape)) for shape in SHAPES.values())
    return "## Shapes: `feature.shape`\n\n" + table(("name", "shape", "keys", "source", "checked against"), rows)


def criteria():
    """A fatigue criterion a row."""
    rows = ((code(rule.name), plain(rule.says), plain(rule.sensitivity), plain(rule.source), _checked(rule))
            for rule in CRITERIA.values())
    return "## Criteria: `fatigue.criterion`\n\n" + table(("name", "criterion", "kappa: sensitivity to", "source",
                                                           "checked against"), rows)


def relations():
    """A relation between hardness and fatigue limit a row."""
    rows = ((code(one.name), plain(one.says), f"{one.low:g} to {one.high:g}", plain(one.spread), plain(one.source),
             _checked(one)) for one in RELATIONS.values())
    return "## Fatigue limit by hardness: `fatigue.relation`\n\n" + table(("name", "relation", "HV", "spread", "source",
                                                                           "checked against"), rows)


def hardenings():
    """A hardening law a row."""
    rows = ((code(one.name), plain(one.says), plain(one.source), _checked(one)) for one in HARDENINGS.values())
    return "## Hardening of steel in run-in: `bodies.X.hardening`\n\n" + table(("name", "flow stress", "source",
                                                                              "checked against"), rows)


def fillings():
    """What fills a crack, a row each."""
    rows = ((code(one.name), plain(one.says), plain(one.source), _checked(one)) for one in FILLINGS.values())
    return "## Inside a crack: `tehl crack --oil`\n\n" + table(("name", "what", "source", "checked against"), rows)


def oils():
    """A named oil a row."""
    rows = ((code(entry.name), plain(entry.says), code(entry.oil.viscosity), *entry.shown_numbers, plain(entry.source))
            for entry in NAMED.values())
    return "## Oils: `oil.name`\n\n" + table(("name", "what", "viscosity law", "η at 40 °C, mPa s", "at 100 °C",
                                               "α at 40 °C, 1/GPa", "source"), rows)


def steels():
    """A named steel a row."""
    rows = ((code(name), plain(steel.says), *(f"{steel.numbers[key]:g}" for key in ("E", "nu", "k", "rho", "c", "alpha")),
             plain(steel.source)) for name, steel in STEELS.items())
    return "## Steels: `bodies.a.material`\n\n" + table(("name", "what", "E, Pa", "ν", "k, W/mK", "ρ, kg/m³", "c, J/kgK",
                                                         "α, 1/K", "source"), rows)
