"""The documentation says what the code says: keys, messages, commands; what Markdown and LaTeX would swallow is refused."""

import ast
import importlib.util
import inspect
import re
import subprocess
import sys
import tomllib
from collections import Counter
from pathlib import Path

import pytest
import typer.main
from handbook import equations, lists, makers, scene_keys
from tehl_cli.main import app

from tehl_taichi.laws.choices import CHOICES
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.runs.summary import result_warnings
from tehl_taichi.scene import domain, grid_for_error, scene, scene_file, scene_warnings
from tehl_taichi.scene.surface.maps import map_warnings

ROOT = Path(__file__).parents[1]
PAGES = sorted((ROOT / "docs").glob("*.md"))
SOURCES = [path for folder in ("tehl_taichi", "cli") for path in (ROOT / folder).rglob("*.py")]
SPOKEN = "…"  # in messages of the page: what differs from case to case


def keys_of(data, before=""):
    """Dotted keys of a parsed scene file."""
    for key, value in data.items():
        inner = value[0] if isinstance(value, list) and value and isinstance(value[0], dict) else value
        yield from keys_of(inner, f"{before}{key}.") if isinstance(inner, dict) else [before + key]


def test_every_key_of_a_new_scene_file_stands_in_the_reference():
    reference = scene_keys.text()
    keys = [key for key in keys_of(tomllib.loads(scene_file.dumps(scene("gear"))))]
    assert len(keys) > 100
    missing = [key for key in keys if f"{{ #{key} }}" not in reference and not key.startswith("bodies.b.")]
    assert not missing


def test_the_reference_has_the_words_of_new_scene_files():
    """Unit, meaning and range, as they stand behind each value there."""
    unescaped = re.sub(r"\\(.)", r"\1", scene_keys.text())
    rows = dict(re.findall(r"^\| `\w+`\{ #([\w.]+) \} \| (.*) \|$", unescaped, re.M))
    template, section = scene_file.dumps(scene("gear")), ""
    for line in template.splitlines()[1:]:
        words, _, comment = line.partition("  # ")
        if words.startswith("["):
            section = words.strip().strip("[]")
        elif comment and section != "bodies.b":
            _, unit, meaning, allowed = rows[f"{section}.{words.split(' = ')[0]}".removeprefix(".")].split(" | ")
            said = meaning + (f" [{allowed}]" if allowed.strip() else "")
            assert comment in ([f"{unit}: {said}"] if unit else [f"-: {said}", said]), line


def texts_of(path):
    """Every text of a source file, with … for what is filled in."""
    return parts_of(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))


def parts_of(nodes):
    """Texts among nodes of a syntax tree, as :func:`texts_of`."""
    for node in nodes:
        if isinstance(node, ast.JoinedStr):
            yield "".join(part.value if isinstance(part, ast.Constant) else SPOKEN for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


def says(text, message):
    """Whether a text of the code has the parts of a message in their order."""
    at = 0
    for part in message.strip(SPOKEN + " ").split(SPOKEN):
        at = text.find(part, at)
        if at < 0:
            return False
        at += len(part)
    return True


def test_every_message_of_the_troubleshooting_page_is_one_of_the_code():
    texts = {text for path in SOURCES for text in texts_of(path) if " " in text}
    page = (ROOT / "docs" / "troubleshooting.md").read_text(encoding="utf-8")
    messages = re.findall(r"^### `(.*)`$", page, re.M)
    assert len(messages) > 40
    assert [message for message in messages if not any(says(text, message) for text in texts)] == []


def text_of(node, named):
    """Text of an expression, with … for what is filled in; named: {name: text} of the function around it."""
    if isinstance(node, ast.Name):
        return named.get(node.id, SPOKEN)
    if isinstance(node, ast.BinOp):
        return text_of(node.left, named) + text_of(node.right, named)
    if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "with_data":
        return text_of(node.args[0], named)
    return next(iter(parts_of([node])), SPOKEN)


def sentences_of(function):
    """Sentences that a check yields or makes, by :func:`text_of`."""
    nodes = list(ast.walk(function))
    assigned = [node for node in nodes if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)]
    named = {node.targets[0].id: text_of(node.value, {}) for node in assigned}
    inside = [node.value.elt if isinstance(node.value, ast.GeneratorExp) else node.value for node in nodes
              if isinstance(node, ast.Yield | ast.YieldFrom) and node.value]
    made = [node for node in nodes if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "with_data"]
    return {text for node in (*inside, *made) if len(text := text_of(node, named)) > 20}


CHECKED = {*scene_warnings.CHECKS, *result_warnings.CHECKS, *result_warnings.ROUGH_CHECKS, map_warnings.doubts}
SHOWN_BEFORE = {"lines", "_roughness", "form"}  # functions of sentences about features that warn of nothing
JOINED = {"_rough"}  # of sentences whose parts have entries


def test_every_warning_has_an_entry_on_the_troubleshooting_page():
    page = (ROOT / "docs" / "troubleshooting.md").read_text(encoding="utf-8")
    messages = [one for one in re.findall(r"`([^`\n]*)`", page) if one.count(" ") > 2 and not one.startswith("tehl ")]
    files = {inspect.getsourcefile(check) for check in CHECKED} | {domain.__file__}
    functions = [node for file in files for node in ast.walk(ast.parse(Path(file).read_text(encoding="utf-8")))
                 if isinstance(node, ast.FunctionDef) and node.name not in SHOWN_BEFORE | JOINED]
    warnings = {text for function in functions for text in sentences_of(function)}
    assert len(warnings) > 45
    assert [text for text in warnings if not any(says(text, message) for message in messages)] == []
    assert [text for text in warnings if "--" in text] == []  # options come with words for a page


def test_every_law_and_criterion_stands_in_the_theory():
    theory = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
    names = [name for registry in (*CHOICES.values(), CRITERIA) for name in registry]
    assert [name for name in names if f"`{name}`" not in theory] == []


def commands(found, words="tehl"):
    """{words that are typed: names of its options} of a command and of those below it."""
    inner = getattr(found, "commands", {})
    out = {words: {name for parameter in found.params for name in (*parameter.opts, *parameter.secondary_opts)}}
    for name, each in inner.items():
        out |= commands(each, f"{words} {name}")
    return out


@pytest.mark.parametrize("page", [*PAGES, ROOT / "README.md"], ids=lambda path: path.name)
def test_commands_in_the_pages_are_those_of_the_command_line(page):
    known = commands(typer.main.get_command(app))
    everywhere = {"--help", "--debug", "--version"}
    for line in re.findall(r"(?:`|^)(tehl [^`\n]*)", page.read_text(encoding="utf-8"), re.M):
        words = [word for word in line.split() if re.fullmatch(r"[a-z]+", word)]
        name = " ".join(words[:3] if words[:2] == ["tehl", "bench"] else words[:2])
        options = set(re.findall(r"(?<!\S)--[a-z][a-z-]*", line))
        assert options <= everywhere if name == "tehl" else name in known or words[:2] == ["tehl", "bench"], line
        assert options - everywhere <= known.get(name, set()), line


def test_pages_name_only_what_is_made():
    for page in PAGES:
        filled = makers.filled(page.read_text(encoding="utf-8"))
        assert "<!-- made:" not in filled and "<!-- file:" not in filled
    with pytest.raises(KeyError, match="nothing"):
        makers.filled("<!-- made: nothing -->")


MARKED = re.compile(r"^(.*)<!-- (made|file): (\S+) -->$", re.M)


@pytest.mark.parametrize("page", [page for page in PAGES if "<!-- " in page.read_text(encoding="utf-8")],
                         ids=lambda path: path.name)
def test_what_is_made_for_a_page_is_pointed_to_where_the_page_lies(page):
    """A checkout shows no more than that line, a built page what it stands for, and not both."""
    text = page.read_text(encoding="utf-8")
    filled, found = makers.filled(text), MARKED.findall(text)
    assert len(found) == text.count("<!-- ") - text.count("<!-- bench")
    for before, kind, name in found:
        links = re.findall(r"\[([^]]+)\]\(\.\./([^)#]+)[^)]*\)", before)
        assert links == [(name, name)] if kind == "file" else links or re.search(r"`[^`]+`", before), before
        assert all((ROOT / path).exists() for _, path in links) and before.strip() not in filled


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_lines_of_text_are_not_longer_than_132_letters(page):
    """Rows of tables cannot be broken, nor what a page is marked with."""
    lines = page.read_text(encoding="utf-8").splitlines()
    assert [line for line in lines if len(line) > 132 and not line.startswith("|") and not MARKED.match(line)] == []


def test_every_page_stands_in_the_navigation():
    named = re.findall(r": (\w+\.md)$", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"), re.M)
    assert sorted(named) == [page.name for page in PAGES]


JUDGED = re.compile(r"^\| (?!worse body)(.*) \| \*\*(follows|does not follow|not decided)\*\* \|", re.M)
WORDS = {1: "one", 10: "ten"}


def test_the_count_of_statements_is_that_of_the_tables():
    """Rows with a window, which come later, replace those of the whole passage without one."""
    page = (ROOT / "docs" / "conclusions.md").read_text(encoding="utf-8").replace("\u2212", "-")
    count = Counter(dict(JUDGED.findall(page)).values())
    follow, against, open_ = (WORDS.get(count[one], str(count[one])) for one in ("follows", "does not follow", "not decided"))
    counted = f"Of {count.total()} statements about the body with the feature {follow} follow, {against} do not follow and "
    assert f"{counted}{open_} is" in (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")
    assert f"**Not decided**, {count['not decided']} of the {count.total()} statements" in page


@pytest.mark.parametrize("short, title, whole", [("README.md", "Validation", "docs/validation.md"),
                                                 ("docs/validation.md", "Coverage of the error bars", "docs/performance.md")])
def test_numbers_of_a_short_form_are_those_of_the_page_that_it_sums_up(short, title, whole):
    section = re.search(rf"^## {title}\n(.*?)^## ", (ROOT / short).read_text(encoding="utf-8"), re.M | re.S)[1]
    numbers, page = re.findall(r"(?<![\w.])\d+(?:\.\d+|e-\d+)(?: %)?", section), (ROOT / whole).read_text(encoding="utf-8")
    assert len(numbers) > 5 and [one for one in numbers if one not in page] == []


def test_the_grid_for_an_error_is_chosen_by_the_table_of_the_page():
    """The largest error of film, pressure and index: what `tehl bench accuracy --keep` writes with that table."""
    table = (ROOT / "docs" / "performance.md").read_text(encoding="utf-8").partition("<!-- bench: accuracy -->")[2]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.partition("<!-- bench end")[0].splitlines()]
    shown: dict[str, dict] = {}
    for family, columns, _, *errors in (row[:7] for row in rows if len(row) > 7 and row[1].isdigit()):
        shown.setdefault(family, {})[columns] = max(float(one.rstrip("*")) for one in errors if one) / 100
    kept = {family: one["errors"] for family, one in grid_for_error.families().items()}
    assert len(shown) == 4 and {family: pytest.approx(one, rel=1e-9) for family, one in shown.items()} == kept


@pytest.mark.parametrize("text", ["some words\n* a list", "some words\n| a | b |", "words\n1. first"])
def test_lists_and_tables_that_stay_text_are_refused(text):
    with pytest.raises(ValueError, match="no empty line before"):
        lists.checked(f"<p>{text}</p>")
    assert lists.checked("<p>a * b\nc - d</p><ul>\n<li>x</li>\n</ul>")


def test_equations_become_mathml_or_are_refused():
    pytest.importorskip("latex2mathml", reason="needs the docs extra: pip install 'tehl_taichi[docs]'")
    drawn = equations.drawn('<p><span class="arithmatex">\\(a &lt; \\frac{1}{2}\\)</span></p>')
    assert "<mfrac>" in drawn and "&#x0003C;" in drawn and "arithmatex" not in drawn
    with pytest.raises(ValueError, match="nosuchword is not known"):
        equations.drawn('<div class="arithmatex">\\[\\nosuchword x\\]</div>')


@pytest.mark.slow
def test_the_pages_build_without_a_warning_and_load_nothing_from_elsewhere(tmp_path):
    for name in ("mkdocs", "material", "latex2mathml"):
        if not importlib.util.find_spec(name):
            pytest.skip(f"{name} is not installed: pip install 'tehl_taichi[docs]'")
    built = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", tmp_path], cwd=ROOT,
                           capture_output=True, text=True)
    assert built.returncode == 0, built.stderr
    for page in tmp_path.glob("*.html"):
        text = page.read_text(encoding="utf-8")
        assert not re.findall(r'<(?:script|link|img|iframe)[^>]*(?:src|href)="(?:https?:)?//[^"]*"', text), page.name
        assert "arithmatex" not in text, page.name
    assert "<math" in (tmp_path / "theory.html").read_text(encoding="utf-8")
