"""Pieces of Markdown."""


def table(columns, rows):
    """Lines of a table; what stands in a cell may hold | and line breaks."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(cell(value) for value in line) + " |" for line in lines)


def cell(value):
    """Text as it may stand in a cell."""
    return " ".join(str(value).replace("|", "\\|").split())


def code(value):
    """Text that is shown as it is."""
    return f"`{cell(value)}`" if str(value) else ""


def plain(text):
    """Text of the code, of which Markdown would make something else: stars, underscores, brackets; `words` stay code."""
    parts = text.split("`")
    if len(parts) % 2 == 0:
        return _escaped(text)
    return "`".join(part if n % 2 else _escaped(part) for n, part in enumerate(parts))


def _escaped(text):
    return "".join("\\" + letter if letter in "*_[]<$`" else letter for letter in text)


def sentence(text):
    """With a capital letter and a full stop."""
    return text[:1].upper() + text[1:].rstrip(".") + "."
