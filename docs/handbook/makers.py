"""Pages name what is made for them, `<!-- made: NAME -->`, and files that they show, `<!-- file: PATH -->`, at the end of a
line: what stands before it is for those who read the page as it lies there, and gives way with it."""

import re
from pathlib import Path

from handbook import choices, commands, extending, outputs, public_names, scene_keys, scenes

ROOT = Path(__file__).parents[2]
MAKERS = {module.__name__.rpartition(".")[2]: module.text
          for module in (choices, commands, extending, outputs, public_names, scene_keys, scenes)}
MADE, SHOWN = (re.compile(rf"^.*<!-- {kind}: (\S+) -->$", re.MULTILINE) for kind in ("made", "file"))
LANGUAGES = {".py": "python", ".toml": "toml"}


def filled(markdown):
    """The page with everything that is made for it. Raises KeyError for a name that nothing makes, OSError for a file that is
    not there."""
    return SHOWN.sub(lambda mark: shown(mark[1]), MADE.sub(lambda mark: MAKERS[mark[1]](), markdown))


def shown(path):
    """A file of the repository as a block of code."""
    file = ROOT / path
    return f"```{LANGUAGES[file.suffix]}\n{file.read_text(encoding='utf-8').strip()}\n```"
