"""Parts of a page, and its HTML."""

from dataclasses import dataclass, field
from pathlib import Path

from tehl_taichi.report.embed import as_json, library, pack
from tehl_taichi.values.coded_text import without_options
from tehl_taichi.values.escape import label, printable

TEMPLATES = Path(__file__).parent / "templates"


@dataclass(frozen=True)
class PageBlock:
    """A part of a page. kind: its template, templates/parts/KIND.html; data: for the template."""

    kind: str
    data: dict

    @property
    def figures(self):
        """Its figures, each a :class:`tehl_taichi.report.plots.Figure`."""
        return self.data.get("figures", ())


@dataclass(frozen=True)
class Section:
    """A heading and its parts (None: nothing to show); a section without parts is left out. front: it belongs to the answer,
    right below it and on the second printed page; others are an appendix.
    """

    title: str
    parts: tuple
    front: bool = False

    @property
    def shown(self):
        return [part for part in self.parts if part]

    @property
    def anchor(self):
        """Its name in links."""
        return self.title.lower().replace(" ", "-")


@dataclass(frozen=True)
class Answer:
    """question; headline: the answer in one sentence; tone: yes, no, open or none, for the colour; sentences: reasons; doubts:
    uncertainties; warnings: of the run; known_before: those that the scene gave before the run.
    """

    question: str
    headline: str
    tone: str
    sentences: tuple = ()
    doubts: tuple = ()
    warnings: tuple = ()
    known_before: tuple = ()

    @property
    def groups(self):
        """[(heading, warnings)] that are not empty, in words for readers: first those of the result, which affect the
        answer.
        """
        found = [without_options(one) for one in self.warnings if one not in self.known_before]
        known = [without_options(one) for one in self.warnings if one in self.known_before]
        return [group for group in (("About the result", found), ("About the scene", known)) if group[1]]


@dataclass(frozen=True)
class Page:
    """title; about: one line about its subject; answer; sections."""

    title: str
    about: str
    answer: Answer
    sections: tuple = field(default_factory=tuple)

    @property
    def front(self):
        """Sections that belong to the answer: those with `front`, else the first."""
        found = [section for section in self.sections if section.shown]
        return [section for section in found if section.front] or found[:1]

    @property
    def shown(self):
        """All sections with content, those of the answer first."""
        first = self.front
        return first + [section for section in self.sections if section.shown and section not in first]

    @property
    def figures(self):
        """{name: figure} of all sections."""
        return {figure.name: figure for section in self.shown for part in section.shown for figure in part.figures}


def table(head, rows, caption="", words=1):
    """A table whose first columns are words; None without rows."""
    return PageBlock("table", {"head": head, "rows": rows, "caption": caption, "words": words}) if rows else None


def facts(rows):
    """A table of pairs (label, value); None without any."""
    return PageBlock("facts", {"rows": rows}) if rows else None


def sentences(items, title=""):
    """A list of sentences; None without any."""
    return PageBlock("sentences", {"items": items, "title": title}) if items else None


def links(rows, title):
    """A line of (text, file beside the page); None without any."""
    return PageBlock("links", {"rows": rows, "title": title}) if rows else None


def figure_block(*figures):
    """Figures next to each other if the page is wide enough; None without figures."""
    found = [figure for figure in figures if figure]
    return PageBlock("figures", {"figures": found}) if found else None


def render(page):
    """HTML of a :class:`Page`."""
    import jinja2

    world = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                               undefined=jinja2.StrictUndefined, finalize=_spell)
    figures = {name: _escape_labels(figure.spec) for name, figure in page.figures.items()}
    return world.get_template("page.html").render(page=page, library=library() if figures else "",
                                                  figures=pack(as_json(figures)))


def _spell(value):
    """Value of a template with non-printing letters spelled."""
    return printable(value, "\n") if type(value) is str else value  # Markup is ours


LABELS = ("text", "name", "ticktext", "legendgroup")


def _escape_labels(spec, key=""):
    """Description of a figure with its labels escaped for plotly.js."""
    if isinstance(spec, dict):
        return {name: _escape_labels(value, name) for name, value in spec.items()}
    if isinstance(spec, (list, tuple)):
        return [_escape_labels(value, key) for value in spec]
    return label(spec) if isinstance(spec, str) and key in LABELS else spec
