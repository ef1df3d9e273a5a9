"""Strength tables that the section [fatigue] names: read once, then stored as text in the scene and its stores."""

import hashlib
import os

from tehl_taichi.errors import SceneError
from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.scene.strength import table, table_file
from tehl_taichi.scene.strength.profiles import PLAIN, PROFILES
from tehl_taichi.scene.strength.table import HARDNESS

KEYS = {"table": "table_rows", "table_b": "table_rows_b"}
ROWS_OF = {f"fatigue.{key}": rows for key, rows in KEYS.items()}


def read(fatigue):
    """Read the tables of a section [fatigue] that has not read them yet. Raises SceneError."""
    for key, rows in KEYS.items():
        place, known = getattr(fatigue, key), getattr(fatigue, rows)
        if place and not known:
            plain = place == PLAIN and key == "table_b"
            object.__setattr__(fatigue, rows, PLAIN if plain else table_file.text_of(place, f"fatigue.{key}"))
    for surface in "ab":
        _check(fatigue, text_of(fatigue, surface))


def text_of(fatigue, surface):
    """Text of the table of a body, "" without one."""
    own = (fatigue.table_rows_b or fatigue.table_rows) if surface == "b" else fatigue.table_rows
    return "" if own == PLAIN else own


def words(fatigue, bodies="ab"):
    """Text of these bodies such as 'over the depth by the table case.csv, limit by the relation ss2506 (source; spread)', ""
    without a table.
    """
    texts = [text for text in dict.fromkeys(text_of(fatigue, body) for body in bodies) if text]
    if not texts:
        return ""
    names = dict.fromkeys(filter(None, (name_of(fatigue, body) for body in bodies)))
    known = f"over the depth by the table {' and '.join(names) or 'of the scene'}"
    if not any(table.of_text(text).has(HARDNESS) for text in texts):
        return known
    relation = RELATIONS[fatigue.relation]
    return f"{known}, limit by the relation {relation.name} ({relation.source}; spread: {relation.spread})"


def name_of(fatigue, surface):
    """Name of the table of a body (of a file without its folders); "" without one."""
    place = fatigue.table_b if surface == "b" and fatigue.table_rows_b else fatigue.table
    return os.path.basename(place) if text_of(fatigue, surface) else ""


def strength_words(fatigue, surface):
    """Text about the strength of a body over its depth; different tables have different texts."""
    if not (text := text_of(fatigue, surface)):
        return "equal at every depth"
    by = f" by {fatigue.relation}" if table.of_text(text).has(HARDNESS) else ""
    digest = hashlib.sha256(text.encode()).hexdigest()[:6]
    return f"of the table {name_of(fatigue, surface) or 'of the scene'} ({digest}){by}"


def _check(fatigue, text):
    """Refuse a text that is no table, and a relation that does not fit the criterion. Raises SceneError."""
    if not text:
        return
    try:
        found = table.of_text(text)
    except (ValueError, KeyError):
        raise SceneError("fatigue.table_rows holds no table of strength; set it to \"\" and fatigue.table to a file") from None
    table_file.check(found)
    if found.has(HARDNESS):
        RELATIONS[fatigue.relation].check(fatigue)


def with_folder(values, folder):
    """{key: path} of the tables of a parsed section [fatigue] that are files, with paths relative to `folder` resolved."""
    names = {key: values[key] for key in KEYS if isinstance(values.get(key), str) and values[key]}
    return {key: str(folder / name) for key, name in names.items() if name not in (*PROFILES, PLAIN)}
