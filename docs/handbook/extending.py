"""Guide to new choices: the section of CONTRIBUTING.md whose files the tests add to a copy of the package and run."""

from pathlib import Path

SOURCE = Path(__file__).parents[2] / "CONTRIBUTING.md"
HEADING = "## One file for one idea\n"


def text():
    """Text of that section, without its heading."""
    _, _, after = SOURCE.read_text(encoding="utf-8").partition(HEADING)
    if not after:
        raise ValueError(f"{SOURCE.name} has no section {HEADING.strip()!r}")
    return after.partition("\n## ")[0].replace("\n### ", "\n## ").strip()
