"""Reference of the scene keys, from the declarations that the checks and `tehl new` read."""

import dataclasses
import inspect

from handbook.tables import code, plain, table
from tehl_taichi.scene.aliases import EXCLUSIVE, SHORT
from tehl_taichi.scene.description import SECTIONS, TOP, Scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.scene_file import toml_value
from tehl_taichi.scene.sections import Body
from tehl_taichi.values.quantity import kinds

# as they follow each other in a file of `tehl new`: {heading: (first part of the dotted key, class)}
PARTS = {"contact": ("contact", SECTIONS["contact"]), "bodies.a and bodies.b": ("bodies.a", Body),
         "operation": ("operation", SECTIONS["operation"]), "oil": ("oil", Oil), "rheology": ("rheology", SECTIONS["rheology"]),
         "feature": ("feature", Feature),
         **{key: (key, kind) for key, kind in SECTIONS.items() if key not in ("contact", "operation", "rheology")}}
COLUMNS = ("key", "default", "unit", "meaning", "allowed")


def text():
    """Keys above the tables, all sections, then short names and what excludes each other."""
    parts = [section(heading, *part) for heading, part in PARTS.items()]
    return "\n\n".join([top(), *parts, short_names(), exclusive()])


def top():
    """A row a key that stands above all tables."""
    defaults = {field.name: field.default for field in dataclasses.fields(Scene)}
    rows = ((f"{code(key)}{{ #{key} }}", code(toml_value(defaults[key])), "", plain(declared.about), "")
            for key, declared in TOP.items())
    return "## Above the tables { #top }\n\n" + table(COLUMNS, rows)


def section(heading, first, kind):
    """Heading, what the section is, and a row a key."""
    head = "[[feature]]" if heading == "feature" else " and ".join(f"[{name}]" for name in heading.split(" and "))
    title = f"## {code(head)} {{ #{first} }}"
    about = (inspect.getdoc(kind) or "").partition("\n\nParameters\n")[0]
    return "\n\n".join([title, plain(about), table(COLUMNS, rows(first, kind))])


def rows(first, kind):
    """(key with its anchor, default, unit, meaning, allowed) of every key; the texts are those of `tehl new`."""
    defaults = {field.name: field.default for field in dataclasses.fields(kind)}
    for key, declared in kinds(kind).items():
        unit = "" if declared.unit == "-" else declared.unit
        yield (f"{code(key)}{{ #{first}.{key} }}", code(toml_value(defaults[key])), unit, plain(declared.about),
               plain(declared.allowed))


def short_names():
    """Words that options and `tehl.scene(...).replace` take for a dotted key."""
    rows = ((code(short), f"{code(key)}") for short, key in SHORT.items())
    return "## Short names\n\nOf `--set`, `--over`, options and `replace(...)`:\n\n" + table(("short", "key"), rows)


def exclusive():
    """What cannot be given together."""
    rows = (" | ".join(", ".join(code(key) for key in group) for group in groups) for groups in EXCLUSIVE)
    listed = "\n".join("* " + row.replace(" | ", " or ") for row in rows)
    return f"## What excludes each other\n\nOf each line only one of the descriptions can be given:\n\n{listed}"
