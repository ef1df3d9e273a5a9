"""Hooks of MkDocs: generated parts of the pages, and equations as MathML."""

from handbook import equations, lists, makers
from mkdocs.exceptions import PluginError


def on_page_markdown(markdown, page, **_):
    """Each line with `<!-- made: NAME -->` becomes what the code says, one with `<!-- file: PATH -->` the file."""
    try:
        return makers.filled(markdown)
    except (KeyError, OSError, ValueError) as error:
        raise PluginError(f"{page.file.src_uri}: {error!r}") from None


def on_page_content(html, page, **_):
    """Equations drawn by the browser; lists and tables that stayed text are refused."""
    try:
        return equations.drawn(lists.checked(html))
    except ValueError as error:
        raise PluginError(f"{page.file.src_uri}: {error}") from None
