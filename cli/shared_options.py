"""Options that several commands share: parameters of a function that appear in the signature of each command."""

import functools
import inspect
from typing import Any


def none():
    """No options."""


def sharing(place, before, after=none):
    """Decorator of a command: typer reads the parameters of the functions `before` (after its first `place` parameters) and
    `after` (at the end) in place of its `**shared`; the command receives them as keywords.
    """
    return lambda command: _shared(command, place, _parameters(before), _parameters(after))


def _shared(command, place, early, late):
    own = [one for one in _parameters(command) if one.kind != inspect.Parameter.VAR_KEYWORD]
    named = [one.replace(kind=inspect.Parameter.KEYWORD_ONLY) for one in (*own[:place], *early, *own[place:], *late)]
    defaults = {one.name: one.default for one in (*early, *late)}

    @functools.wraps(command)
    def whole(*first, **given):
        return command(*first, **{**defaults, **given})

    typed: Any = whole
    typed.__signature__ = inspect.Signature(named)
    typed.__annotations__ = {one.name: one.annotation for one in named}
    return typed


def _parameters(function):
    return list(inspect.signature(function).parameters.values())
