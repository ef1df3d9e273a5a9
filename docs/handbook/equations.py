"""Equations: LaTeX in the pages, MathML in what is built, which browsers draw without a script or a network."""

import html
import re

INLINE = re.compile(r'<span class="arithmatex">\\\((.*?)\\\)</span>', re.DOTALL)
DISPLAY = re.compile(r'<div class="arithmatex">\s*\\\[(.*?)\\\]\s*</div>', re.DOTALL)


def drawn(page):
    """HTML of a page with its equations as MathML. Raises ValueError for LaTeX that cannot be."""
    page = INLINE.sub(lambda found: mathml(found[1], "inline"), page)
    return DISPLAY.sub(lambda found: f'<div class="equation">{mathml(found[1], "block")}</div>', page)


def mathml(escaped, display):
    """The element of one equation."""
    from latex2mathml.converter import convert

    latex = html.unescape(escaped).strip()
    try:
        made = convert(latex, display=display)
    except Exception as error:  # noqa: BLE001  it has no common one
        raise ValueError(f"cannot draw {latex!r}: {type(error).__name__} {error}") from None
    if unknown := re.findall(r"\\[A-Za-z]+", made):
        raise ValueError(f"cannot draw {latex!r}: {unknown[0]} is not known")
    return made
