"""Wrapped calls of named functions of this package, for measurements."""

import contextlib
import importlib


@contextlib.contextmanager
def wrapped(places, wrapper):
    """Context manager: replace the function at each place {name: "module:Class.method" of tehl_taichi} by wrapper(name,
    function).
    """
    before = []
    for name, place in places.items():
        owner, attribute = _owner(place)
        before.append((owner, attribute, getattr(owner, attribute)))
        setattr(owner, attribute, wrapper(name, getattr(owner, attribute)))
    try:
        yield
    finally:
        for owner, attribute, function in before:
            setattr(owner, attribute, function)


def _owner(place):
    """(module or class, name in it) of a place."""
    module, _, path = place.partition(":")
    owner = importlib.import_module(f"tehl_taichi.{module}")
    *outer, name = path.split(".")
    for part in outer:
        owner = getattr(owner, part)
    return owner, name
