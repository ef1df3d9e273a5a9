"""The public names of the package with their own words and examples, which the tests run."""

import inspect
import re

import tehl_taichi as tehl
from handbook.tables import plain

ROLE = re.compile(r":(?:class|func|meth|attr|data|mod):(?=`)")
HEADING = re.compile(r"^(\w+)\n-+$", re.MULTILINE)  # of a section: Parameters, Returns ...
ENTRY = re.compile(r"^(\S.*)\n((?:    .*\n?)+)", re.MULTILINE)  # of a section: a name, and what it is below it


def text():
    """A section a name: functions first, then classes."""
    names = sorted({*tehl.__all__, "open"} - {"__version__"}, key=lambda name: (inspect.isclass(getattr(tehl, name)), name))
    return "\n\n".join(map(section, names))


def section(name):
    """Signature of a function, docstring in paragraphs, examples as they are typed."""
    thing = getattr(tehl, name)
    head = [f"## `tehl.{name}`"]
    if not inspect.isclass(thing):
        head.append(f"```python\n{name}{inspect.signature(thing)}\n```")
    return "\n\n".join([*head, *parts(ROLE.sub("", inspect.getdoc(thing) or ""))])


def parts(words):
    """Prose, lists and examples of a docstring."""
    about, *sections = HEADING.split(words)
    yield from map(paragraph, filter(None, about.strip().split("\n\n")))
    for title, body in zip(sections[::2], sections[1::2]):
        yield f"**{title}**"
        yield listed(body.strip("\n")) if ENTRY.match(body.strip("\n")) else "\n\n".join(
            map(paragraph, body.strip().split("\n\n")))


def listed(body):
    """Names with what they are, an item each."""
    items = ((name.replace("`", ""), plain(" ".join(what.split()))) for name, what in ENTRY.findall(body + "\n"))
    return "\n".join(f"* `{name}`: {what}" for name, what in items)


def paragraph(words):
    """Prose, or an example."""
    if words.lstrip().startswith(">>>"):
        return f"```pycon\n{words}\n```"
    before, mark, example = words.partition("\n>>>")
    return plain(before) + (f"\n\n```pycon\n>>>{example}\n```" if mark else "")
