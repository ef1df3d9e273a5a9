"""The house: layers, light imports, the README's commands."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "tehl_taichi"
LAYERS = ["scene", "physics", "kernels", "solvers", "simulation", "post", "companions", "io", "cli"]


def layer_of(module):
    parts = module.split(".")
    if parts[0] == "tehl_cli":
        return "cli"
    return parts[1] if parts[0] == "tehl_taichi" and len(parts) > 1 and parts[1] in LAYERS else None


def module_of(path):
    top = "tehl_cli" if path.is_relative_to(ROOT / "cli") else "tehl_taichi"
    base = ROOT / "cli" if top == "tehl_cli" else PACKAGE
    return ".".join((top, *path.relative_to(base).with_suffix("").parts))


def imports(path):
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


SOURCES = sorted([*PACKAGE.rglob("*.py"), *(ROOT / "cli").rglob("*.py")])


@pytest.mark.parametrize("path", SOURCES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_only_from_layers_above(path):
    own = layer_of(module_of(path))
    if own is None:
        return
    for name in imports(path):
        other = layer_of(name)
        if other is not None:
            assert LAYERS.index(other) <= LAYERS.index(own), f"{path} imports {name}"


@pytest.mark.parametrize("path", SOURCES, ids=lambda p: str(p.relative_to(ROOT)))
def test_no_future_annotations(path):
    assert "__future__.annotations" not in set(imports(path))


def test_package_and_scene_do_not_import_taichi():
    code = "import sys, tehl_taichi, tehl_taichi.scene, tehl_cli.main; sys.exit('taichi' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_readme_names_both_lines():
    text = (ROOT / "README.md").read_text()
    lines = [line for line in text.splitlines() if line.startswith("python3 -m venv")]
    assert len(lines) == 2 and "tehl run --srr -0.12" in lines[0] and lines[1].endswith("pytest")


def test_readme_python_example_runs(taichi_cpu, capsys):
    text = (ROOT / "README.md").read_text()
    exec(compile(text.split("```python\n")[1].split("```")[0], "README.md", "exec"), {})
    assert len(capsys.readouterr().out.splitlines()) == 4
