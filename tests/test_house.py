"""The house: layers, light imports, the README's commands."""

import ast
import functools
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "tehl_taichi"
# every module and folder of the package, each imports from those before it only
LAYERS = ["errors", "commit", "disk", "engine", "values", "laws", "scene", "pressure", "heat", "fatigue", "plastic",
          "crack", "march", "store", "view", "runs", "report", "profiles", "cli"]
TOP = {"errors", "commit"}  # single files that everybody may use
# what each room may import besides these and itself; a new arrow is a decision
MAY_IMPORT = {
    "disk": set(), "engine": set(), "values": set(),
    "laws": {"engine", "values"},
    "scene": {"disk", "values", "laws"},
    "pressure": {"engine", "values", "laws", "scene"},
    "heat": {"engine", "values", "laws", "scene", "pressure"},
    "fatigue": {"engine", "values", "laws", "scene"},
    "plastic": {"values", "laws", "scene", "fatigue"},
    "crack": {"engine", "values", "laws", "scene", "fatigue"},
    "march": {"engine", "values", "laws", "scene", "pressure", "heat", "fatigue", "plastic"},
    "store": {"disk", "values", "laws", "scene", "heat", "plastic", "march"},
    "view": {"disk", "values", "scene", "fatigue", "march", "store"}}
ENTRIES = {"__init__", "__main__", "api"}  # of the package: they may lead anywhere, lazily
FOLDERS = {ROOT / "cli": "tehl_cli", ROOT / "profiles": "tehl_taichi.profiles", PACKAGE: "tehl_taichi"}


def layer_of(module):
    """Of a dotted name; None for what is not ours, and for the package itself."""
    top, *parts = module.split(".")
    if top == "tehl_cli":
        return "cli"
    return parts[0] if top == "tehl_taichi" and parts and parts[0] in modules_on_top() else None


@functools.cache
def modules_on_top():
    """Names directly below the package, as they are on the disk (a public function may be imported from it, too)."""
    return {path.stem for path in PACKAGE.iterdir() if path.suffix in ("", ".py")} - ENTRIES | {"profiles"}


def module_of(path):
    base = next(folder for folder in FOLDERS if path.is_relative_to(folder))
    return ".".join((FOLDERS[base], *path.relative_to(base).with_suffix("").parts))


@functools.cache
def nodes(path):
    """Of the syntax tree of a file."""
    return tuple(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))


@functools.cache
def imports(path):
    """Names that a module imports."""
    found = []
    for node in nodes(path):
        if isinstance(node, ast.ImportFrom) and node.module:
            found += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
        elif isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
    return found


SOURCES = sorted(path for folder in FOLDERS for path in folder.rglob("*.py"))


def test_every_module_has_its_layer():
    assert modules_on_top() - {"__pycache__"} == set(LAYERS) - {"cli"}


def may_import(own, other):
    return LAYERS.index(other) <= LAYERS.index(own) and (own not in MAY_IMPORT or other in MAY_IMPORT[own] | TOP | {own})


def test_imports_only_from_layers_above():
    layers = {path: layer_of(module_of(path)) for path in SOURCES}
    assert {(path.parent, path.stem) for path, own in layers.items() if own is None} == {(PACKAGE, name) for name in ENTRIES}
    assert [(path, name) for path, own in layers.items() for name in imports(path)
            if own and (other := layer_of(name)) and not may_import(own, other)] == []


@pytest.mark.parametrize("room", sorted(path.parent.name for path in PACKAGE.glob("*/__init__.py")))
def test_a_room_says_what_lives_there(room):
    lines = ast.get_docstring(ast.parse((PACKAGE / room / "__init__.py").read_text())).splitlines()
    assert 3 <= len(lines) <= 8, room


def names_in(path):
    """All names that a module defines or imports somewhere."""
    for node in nodes(path):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.alias):
            yield node.asname or node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def test_every_import_of_ours_finds_its_name():
    """Those inside functions too, which fail only when they are called."""
    ours = {module_of(path).removesuffix(".__init__"): path for path in SOURCES}
    known = set(ours) | {f"{module}.{name}" for module, path in ours.items() for name in names_in(path)}
    for path in [*SOURCES, *(ROOT / "tests").rglob("*.py")]:
        unknown = {name for name in imports(path) if name.startswith(("tehl_taichi", "tehl_cli"))} - known
        assert not unknown, f"{path} imports {unknown}"


def test_no_future_annotations():
    assert [path for path in SOURCES if "__future__.annotations" in imports(path)] == []


def test_one_folder_knows_taichi():
    """The engine; others take the language, and FFTW, from it."""
    ours = [path for path in SOURCES if not path.is_relative_to(PACKAGE / "engine")]
    assert [path for path in ours if {"taichi", "pyfftw"} & {name.split(".")[0] for name in imports(path)}] == []


WRITES = re.compile(r"write_text\(|write_bytes\(|os\.(replace|rename|unlink|truncate)\(|rmtree\(|\.(unlink|rmdir|touch)\(|"
                    r"open\([^)\n]*[\"'][wa]b?\+?[\"']|savefig\((?!draft)|np\.save")
# what writes by itself: kernels in the cache, a pipe, files of a draft, a lock and a checkpoint of ours, examples
WRITERS = {"runtime.py", "background_errors.py", "vtk_series.py", "csv_tables.py", "checkpoint.py", "case.py",
           "published_films.py", "gallery.py", "make_scan.py", "measured_surface.py"}


def test_one_room_writes_to_disk():
    """No command replaces or removes a file by itself: `disk` knows links, and what is ours."""
    found = {path.name for path in SOURCES if path.parent.name != "disk" and WRITES.search(path.read_text(encoding="utf-8"))}
    assert found == WRITERS


RAISES = re.compile(r"(?<!entry)\.(is_dir|is_file|exists)\(\)")


def test_a_look_at_a_path_never_raises():
    """Path.is_file raises for a name that is too long or a folder that is closed, os.path.isfile does not."""
    ours = [path for path in SOURCES if path.is_relative_to(PACKAGE)]
    assert [path.name for path in ours if RAISES.search(path.read_text(encoding="utf-8"))] == []


def test_package_and_scene_do_not_import_taichi():
    code = "import sys, tehl_taichi, tehl_taichi.scene, tehl_cli.main; sys.exit('taichi' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_help_waits_for_nothing_heavy():
    code = "import sys, tehl_cli.main; sys.exit(bool({'numpy', 'zarr', 'taichi'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_how_to_get_an_extra_is_said_by_one_function():
    from tehl_taichi.errors import extra

    assert extra("plot") == "pip install 'tehl_taichi[plot]' (in a checkout: pip install -e '.[plot]')"
    others = [path for path in SOURCES if path.name != "errors.py"]
    assert [path.name for path in others if "pip install" in path.read_text(encoding="utf-8")] == []
    asked = {name for path in others for name in re.findall(r"\bextra\([\"'](\w+)", path.read_text(encoding="utf-8"))}
    known = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    assert len(asked) >= 5 and asked <= known.keys()


def test_readme_names_both_lines():
    text = (ROOT / "README.md").read_text()
    lines = [line for line in text.splitlines() if line.startswith("python3 -m venv")]
    assert len(lines) == 2 and "tehl run --srr -0.12" in lines[0] and lines[1].endswith("pytest")


def test_solvers_import_neither_dask_nor_pandas():
    """FFTW's package would, where they are installed."""
    code = "import sys; from tehl_taichi.march import passage; sys.exit(bool({'dask', 'pandas', 'scipy'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_docstrings_refer_to_modules_and_classes_that_exist():
    """References break silently when a file is renamed."""
    modules = {"tehl_cli", *(part for path in SOURCES for part in (*path.parts, path.stem))}
    known = {"mod": modules, "class": modules | {name for path in SOURCES for name in names_in(path)}}
    references = [(path, *found) for path in SOURCES
                  for found in re.findall(r":(mod|class):`~?([\w.]+)`", path.read_text(encoding="utf-8"))]
    assert len(references) > 100
    assert [(path, name) for path, role, name in references if set(name.split(".")) - known[role]] == []
