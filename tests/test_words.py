"""Words that readers of a second language do not find in a manual stand in no help, message, page, docstring or comment."""

import ast
import io
import re
import tokenize
from pathlib import Path

import pytest
import typer.main
from handbook import makers
from tehl_cli.main import app

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
SOURCES = sorted(path for folder in ("tehl_taichi", "cli") for path in (ROOT / folder).rglob("*.py"))
CODE = [*SOURCES, *sorted(path for folder in ("profiles", "docs") for path in (ROOT / folder).rglob("*.py"))]
HOUSE = re.compile(r"""\b(
    tells? | told | telling | (?:go|goes|going|gone|went)\son | bears? | borne | by\sturns | nobody | somebody | anybody |
    ask(?:s|ed)?\sfor | at\shand | what\sthere\sis | as\sit\sstands | (?:take|takes|taken|took)\soff | (?:worst|bad)\soff |
    companions? | anew | all\sthe\ssame | that\s(?:is|are)\sthere | the\ssame\sof | side\sby\sside | to\sbe\shad |
    sees?\sto\sit | says?\sit\sall | who\sknows | each\sfor\sitself | in\svain | all\sthere\sis | what\sthere\sare |
    so\smanieth | by\swhatever | where\snothing\s(?:passes|varies|slips|flows|ends)
    )\b""", re.VERBOSE | re.IGNORECASE)
# of things that lie beside each other, in lanes and on pages, a docstring may say so
IN_CODE = {"side by side"}
# local names and parameters are nouns of their subject
NO_NAMES = {"told", "told_of", "tells", "tell", "said", "wanted", "asked", "begun", "gone"}
# a word in its definition
DEFINED = {"docs/numerics.md": "coarse-grid runs (companion runs)"}


def found(text):
    """House words of a text, whatever its lines."""
    return [match[0] for match in HOUSE.finditer(" ".join(text.split()))]


def test_house_words_are_found():
    assert found("not gone\n on with; a file that is there is told of") == ["gone on", "that is there", "told"]
    assert found("Resume an interrupted run; the tolerance, a bearing, a teller, forgone onions") == []


def commands(command, name="tehl"):
    """(name, text of its help and of its parameters) of a command and of those below it."""
    yield name, " ".join([command.help or "", *(getattr(one, "help", None) or "" for one in command.params)])
    for inner, each in getattr(command, "commands", {}).items():
        yield from commands(each, f"{name} {inner}")


HELP = dict(commands(typer.main.get_command(app)))


def test_every_command_has_a_help():
    assert len(HELP) > 25 and all(text.strip() for text in HELP.values())


def test_no_house_word_in_the_help():
    assert {name: words for name, text in HELP.items() if (words := found(text))} == {}


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_house_word_in_a_page(page):
    text = page.read_text(encoding="utf-8").replace(DEFINED.get(str(page.relative_to(ROOT)), "\0"), "")
    assert found(re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)) == []


def test_no_house_word_in_what_is_made_for_the_pages():
    """Names of attributes stand among the public names, whatever they are called."""
    made = {name: make() for name, make in makers.MAKERS.items() if name != "public_names"}
    assert len(made) >= 6 and {name: words for name, text in made.items() if (words := found(text))} == {}


def own_texts(tree):
    """(line, text) of the literals of a module, without docstrings and keys: what users may read."""
    skipped = {id(node.body[0].value) for node in ast.walk(tree)
               if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and isinstance(node.body[0], ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            skipped |= {id(part) for part in ast.walk(node)} - {id(node)}
            yield node.lineno, "".join(str(part.value) if isinstance(part, ast.Constant) else "…" for part in node.values)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in skipped and " " in node.value:
            yield node.lineno, node.value


def test_texts_are_those_that_users_read():
    tree = ast.parse('"""Told."""\nraise E(f"the {told} file is told", "a {0} that bears it")\nt["told"] = f(told)')
    assert list(own_texts(tree)) == [(2, "the … file is told"), (2, "a {0} that bears it")]


def suspects(paths, words=HOUSE):
    """(path, its source) of the files that have such words anywhere; only these are parsed."""
    for path in paths:
        source = path.read_text(encoding="utf-8")
        if words.search(" ".join(re.sub(r"\n\s*#", " ", source).split())):
            yield path, source


def test_no_house_word_in_messages():
    texts = ((path, *one) for path, source in suspects(SOURCES) for one in own_texts(ast.parse(source)))
    assert [f"{path.relative_to(ROOT)}:{line}: {words}" for path, line, text in texts if (words := found(text))] == []


def prose(source):
    """(line, text) of the docstrings and comments of a module; comments on consecutive lines are one text."""
    docstrings = {node.body[0].lineno for node in ast.walk(ast.parse(source))
                  if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node) is not None}
    lines, text = [0], ""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.STRING and token.start[0] in docstrings:
            yield token.start[0], token.string
        elif token.type == tokenize.COMMENT:
            if token.start[0] != lines[-1] + 1:
                yield lines[0], text
                lines, text = [token.start[0]], ""
            lines.append(token.start[0])
            text += token.string.lstrip("#")
    yield lines[0], text


def test_prose_is_what_readers_of_the_code_read():
    found_in = dict(prose('"""Told."""\na = "told"  # it bears\n# it goes\n# on\nb = f(a)\n'))
    assert {line: found(text) for line, text in found_in.items() if text} == {1: ["Told"], 2: ["bears", "goes on"]}


def test_no_house_word_in_docstrings_and_comments():
    texts = ((path, *one) for path, source in suspects(CODE) for one in prose(source))
    assert [f"{path.relative_to(ROOT)}:{line}: {words}" for path, line, text in texts
            if (words := [word for word in found(text) if word not in IN_CODE])] == []


def names(tree):
    """(line, name) of every parameter and every name that is set."""
    for node in ast.walk(tree):
        if isinstance(node, ast.arg):
            yield node.lineno, node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id


def test_no_verb_as_a_name():
    words = re.compile(rf"\b({'|'.join(NO_NAMES)})\b")
    every = ((path, *one) for path, source in suspects(CODE, words) for one in names(ast.parse(source)))
    assert [f"{path.relative_to(ROOT)}:{line}: {name}" for path, line, name in every if name in NO_NAMES] == []


def test_docstrings_begin_with_a_noun_or_a_verb():
    """Those of modules also with no question."""
    opening = re.compile(r'"""(Of|Those|That|And|It|The same)\b.*|\A"""(What|Which|Whether|How|Where|Why)\b.*')
    assert [f"{path.relative_to(ROOT)}: {match[0]}" for path in CODE
            for match in opening.finditer(path.read_text(encoding="utf-8"))] == []
