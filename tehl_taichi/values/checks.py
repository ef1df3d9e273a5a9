"""Checks of input values: one sentence with the value, the unit and the allowed range."""

import contextlib
import dataclasses
import difflib
import math
import os
from collections.abc import Mapping
from typing import Union

from tehl_taichi.errors import SceneError
from tehl_taichi.values.coerce import plain, shown
from tehl_taichi.values.unit_hints import hint

HUGE = 10**300  # whole numbers beyond it are no floats
MANY = 20  # names that a message lists at most
ALIKE = 0.6  # of the letters of a file name, with one that may be meant: my.toml and my
CHANGES = "{key: value}, as in {'srr': 0.1}"  # form of an argument
ALL_KEYS = "`tehl new FILE`"  # writes a scene file with every key


def number(where, value, unit="", low=-math.inf, high=math.inf, strict=False, infinite=False, usual=0.0, least=0.0):
    """Refuse `value` unless it is a number within low..high.

    strict: low itself is refused; infinite: inf is allowed; least: smallest allowed size, except 0. For a value that fits in
    another unit, the message names the one nearest to `usual`.
    """
    allowed = _allowed(unit, low, high, strict, least)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or value != value:
        raise SceneError(f"{where} = {shown(value)} is not a number{allowed}")
    if abs(value) == math.inf and not infinite:
        raise SceneError(f"{where} = {value} must be finite{allowed}")
    if not _within(value, low, high, strict, least, infinite) or (isinstance(value, int) and abs(value) > HUGE):
        text = f"{value:g}" if isinstance(value, float) else shown(value)
        other = hint(value, unit, lambda other: _within(other, low, high, strict, least), usual) if abs(value) <= HUGE else ""
        raise SceneError(f"{where} = {text}{' ' * bool(unit)}{unit} is out of range{allowed}{other}")


def _within(value, low, high, strict, least, infinite=False):
    """Whether a value is in its range; infinite: inf is allowed if the range has no upper end."""
    if infinite and value == math.inf and low > -math.inf:
        return True
    return low <= value <= high and not (strict and value == low) and (value == 0 or abs(value) >= least)


def _allowed(unit, low, high, strict, least=0.0):
    """Text of the range in a refusal; least: smallest size, except 0."""
    unit = " " + unit if unit else ""
    if least:
        above = f"0, or at least {least:g}{unit}"
    else:
        above = f"{'more than' if strict else 'at least'} {low:g}{unit}" if low > -math.inf else ""
    below = f"at most {high:g}{unit}" if high < math.inf else ""
    both = " and ".join(part for part in (above, below) if part)
    return f"; allowed: {both}{', positive or negative' if least and low < 0 else ''}" if both else ""


def word(where, value, only, kind):
    """Refuse a text that is not the only one allowed in place of a number."""
    if value != only:
        raise SceneError(f"{where} = {shown(value)} is not a number; allowed: {kind.allowed}")


def integer(where, value, low, high):
    """Refuse `value` unless it is a whole number within low..high."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, int):
        raise SceneError(f"{where} = {shown(value)} is not a whole number; allowed: {low} to {high}")
    if not low <= value <= high:
        raise SceneError(f"{where} = {shown(value)} is out of range; allowed: {low} to {high}")


def missing_file(name):
    """Refuse an unknown name that is a path, or that of a TOML file without its ending. Raises SceneError."""
    if "." in name or "/" in name or os.path.isfile(f"{name}.toml"):
        raise SceneError(f"{name} {why_absent(name)}")


def why_absent(path):
    """Text about a path that is no file: 'does not exist' with the nearest name, or the reason why it cannot be read."""
    try:
        os.stat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return f"does not exist{near_file(path)}"
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    return "is not a file"


def near_file(path):
    """Text ' (did you mean ...?)' with the file or folder whose path is nearest to a missing one, or nothing."""
    folder, name = os.path.split(path)
    beside: list[str] = []
    if not os.path.lexists(path):
        with contextlib.suppress(OSError):
            beside = [one for one in os.listdir(folder or ".") if not one.startswith(".")]
    close = difflib.get_close_matches(name, beside, n=1, cutoff=ALIKE)
    return f" (did you mean {shown(os.path.join(folder, close[0]))}?)" if close else ""


def choice(where, value, allowed):
    """Refuse `value` unless it is one of `allowed`; names the nearest one. Texts with spaces describe other values."""
    if value not in allowed:
        each = list(filter(None, allowed))
        raise SceneError(f"{where} = {shown(value)} is not known; allowed: "
                         f"{', '.join(each)}{nearest(value, [one for one in each if ' ' not in one])}")


def flag(where, value, other=""):
    """Refuse anything but true or false (`other`: a word that the caller allows too)."""
    if not isinstance(value, bool):
        raise SceneError(f"{where} = {shown(value)} must be " + (f"true, false or {other!r}" if other else "true or false"))


def table(where, value, example):
    """Refuse anything but a dictionary, as in `example`."""
    if not isinstance(value, Mapping):
        raise SceneError(f"{where} = {shown(value)} must be a dictionary {example}")


def callback(where, given, method="", allowed="a function, or None"):
    """Refuse an object that cannot be called, or whose `method` cannot; None is allowed."""
    if given is not None and not callable(getattr(given, method, None) if method else given):
        lacks = f"has no method {method}" if method else "is no function"
        raise SceneError(f"{where} = {shown(given)} {lacks}; allowed: {allowed}")


def text(where, value, most=500, printable=True, empty=True):
    """Refuse `value` unless it is text of at most `most` characters (`printable`: on one line, without control characters)."""
    if not isinstance(value, str) or not (empty or value.strip()):
        raise SceneError(f"{where} = {shown(value)} must be text{'' if empty else ', and not empty'}")
    if len(value) > most:
        raise SceneError(f"{where} = {shown(value)} has {len(value)} characters; allowed: at most {most}")
    if printable and not value.isprintable() or any("\ud800" <= c <= "\udfff" for c in value):
        raise SceneError(f"{where} = {shown(value)} must be text on one line, without control characters")


def file_name(where, value):
    """Refuse `value` unless a folder can have this name: text without path separators, at most 100 characters."""
    text(where, value, 100)
    if not value.strip(" .") or value != value.strip() or len(value.encode()) > 200:
        raise SceneError(f"{where} = {shown(value)} must be a name, as 'gear': not empty, without blanks at its ends")
    if "/" in value or "\\" in value:
        raise SceneError(f"{where} = {shown(value)} must be a name without path separators: stores are named after it")


def nearest(word, allowed):
    """Text ' (did you mean ...?)' for the closest known word, or nothing."""
    word = word[:100] if isinstance(word, str) else shown(word)
    known = {str(a).lower(): str(a) for a in allowed}
    close = difflib.get_close_matches(word.lower(), known, n=5, cutoff=0.5) or _with(word.lower(), known)
    return f" (did you mean {known[max(close, key=lambda one: _likeness(one, word.lower()))]!r}?)" if close else ""


def known_names(known, place):
    """End of a message about an unknown name: up to MANY known names, or the `place` (text) that lists all of them."""
    names = list(map(str, known))
    return f"known: {', '.join(names)}" if len(names) <= MANY else f"all {len(names)} names: {place}"


def _with(word, known):
    """Names that contain a word of at least three letters, or a shorter one between underscores."""
    return [name for name in known if len(word) > 2 and word in name or word in name.split("_")]


def _likeness(one, word):
    """Similarity of a known name to a word; of equally similar names the one with the longer common beginning."""
    return difflib.SequenceMatcher(None, one, word).ratio(), len(os.path.commonprefix([one, word]))


def normalise(part):
    """Give a frozen dataclass plain Python values (see :func:`plain`), and floats for whole numbers in float fields."""
    for field in dataclasses.fields(part):
        value = plain(getattr(part, field.name))
        real = field.type in (float, Union[float, str])
        if real and isinstance(value, int) and not isinstance(value, bool) and abs(value) <= HUGE:
            value = float(value)
        object.__setattr__(part, field.name, value)


def build(cls, values, section, general=None):
    """Return cls(**values); refuse unknown keys. Messages name `section` in place of the `general` name of cls."""
    known = [f.name for f in dataclasses.fields(cls)]
    if not isinstance(values, dict):
        raise SceneError(f"[{section}] must be a table of keys and values, not {shown(values)}; set its keys, as "
                         f"{section}.{known[0]} and {section}.{known[1]}")
    for key in values:
        if key not in known:
            raise SceneError(unknown_key(section, key, known))
    with messages_about(section, general or section):
        return cls(**values)


def unknown_key(section, key, known):
    """Message about a key that a section does not have."""
    return f"unknown key {section}.{key_shown(key)}{nearest(key, known)}; {known_names(known, ALL_KEYS)}"


@contextlib.contextmanager
def messages_about(section, general):
    """Context manager: messages about `general`.key name `section`.key instead, for a body or feature."""
    try:
        yield
    except SceneError as error:
        raise type(error)(str(error).replace(f"{general}.", f"{section}.")) from None


def key_shown(key):
    """Text of a key in a sentence."""
    return key if isinstance(key, str) and key.isprintable() and len(key) < 60 else shown(key)
