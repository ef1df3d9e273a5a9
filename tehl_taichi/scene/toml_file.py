"""Reading of TOML files that people write."""

import re
import tomllib

from tehl_taichi.disk import files
from tehl_taichi.errors import SceneError
from tehl_taichi.values.checks import near_file, nearest
from tehl_taichi.values.coerce import shown

COMMA = re.compile(r"\s*[\w.\"'-]+\s*=\s*([-+]?\d+),(\d+(?:[eE][-+]?\d+)?)\s*(?:#.*)?")  # key = -0,2
LINE = re.compile(r"\(at line (\d+), ")


def read(path, what, known=None):
    """Nested dictionary of a TOML file; what: "scene", for messages; known: its keys (None: not checked here).

    Raises SceneError if it cannot be read, is no TOML or has an unknown key; the message points out a decimal comma.
    """
    data = _read(path, what)
    for key in data if known else ():
        if key not in known:
            raise SceneError(f"unknown key {shown(key)} in {path}{nearest(key, known)}; known: {', '.join(known)}")
    return data


def _read(path, what):
    try:
        text = files.text(path)
        return tomllib.loads(text)
    except (OSError, UnicodeDecodeError) as error:
        raise SceneError(f"cannot read {what} file {path}: {getattr(error, 'strerror', None) or error}"
                         f"{near_file(path)}") from None
    except RecursionError:
        raise SceneError(f"{path} nests tables or lists too deeply; a {what} has two levels") from None
    except ValueError as error:  # of TOML, and of Python for whole numbers of more than 4300 digits
        raise SceneError(f"{path} is not valid TOML: {_with_point(text, error) or error}") from None


def check_brackets(path, data, one=(), several=()):
    """Refuse [NAME] in place of [[NAME]], and vice versa. one, several: names of single tables and of repeated tables. Raises
    SceneError.
    """
    for names, required, other in ((one, "[{}]", "[[{}]]"), (several, "[[{}]]", "[{}]")):
        for name in names:
            found = data.get(name)
            if found is None or _is_kind(found, name in several):
                continue
            brackets = isinstance(found, dict) or found and _is_kind(found, True)
            written = other.format(name) if brackets else f"{name} = {shown(found)}"
            raise SceneError(f"{written} in {path} must be {required.format(name)}, the header of a table of keys and "
                             f"values{' (each with its own header)' if name in several else ''}")


def _is_kind(found, several):
    return isinstance(found, list) and all(isinstance(one, dict) for one in found) if several else isinstance(found, dict)


def _with_point(text, error):
    """Message about a line with a decimal comma, None for other errors."""
    line = LINE.search(str(error))
    number = int(line[1]) if line else 0
    lines = text.split("\n")
    found = COMMA.fullmatch(lines[number - 1].rstrip("\r")) if 0 < number <= len(lines) else None
    return found and f"line {number} has a decimal comma; TOML needs a point: {found[1]}.{found[2]}"
