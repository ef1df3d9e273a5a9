"""The public names of the package with their own words and examples, which the tests run."""

import inspect
import re

import tehl_taichi as tehl
from handbook.tables import plain

ROLE = re.compile(r":(?:class|func|meth|attr|data|mod):(?=`)")


def text():
    """A section a name."""
    return "\n\n".join(section(name) for name in tehl.__all__ if name != "__version__")


def section(name):
    """Signature, docstring in paragraphs, examples as they are typed."""
    thing = getattr(getattr(tehl, name), "called", getattr(tehl, name))
    head = [f"## `tehl.{name}`"]
    if not inspect.isclass(thing):
        head.append(f"```python\n{name}{inspect.signature(thing)}\n```")
    return "\n\n".join([*head, *map(paragraph, inspect.getdoc(thing).split("\n\n"))])


def paragraph(words):
    """Prose, or an example."""
    words = ROLE.sub("", words)
    if words.lstrip().startswith(">>>"):
        return f"```pycon\n{words}\n```"
    before, mark, example = words.partition("\n>>>")
    return plain(before) + (f"\n\n```pycon\n>>>{example}\n```" if mark else "")
