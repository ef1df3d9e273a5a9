import fcntl
import functools
import gc
import importlib
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

MOST = 4  # processes of the whole suite: each needs 1.5 GB
LOCK = "TEHL_FIRST_KERNELS"  # a file that the process of `first_kernels` locks
# that compile the kernels of the solvers, half of a cold suite
KERNELS = tuple(f"tests/{name}" for name in (
    "cli/", "engine/test_float", "heat/", "march/", "pressure/", "profiles/",
    "runs/", "scene/", "store/", "test_examples", "test_new", "values/test_coded", "values/test_unit"))
CRITERIA = tuple(f"tests/{name}" for name in ("fatigue/test_findley", "laws/test_criteria", "scene/test_given"))
FIGURES = "tests/view/test_figures", "tests/view/test_surface"  # about as long as the first kernels
SOLVERS = (*KERNELS, "tests/crack/", "tests/engine/", "tests/fatigue/", "tests/laws/")  # that use Taichi at all


def pytest_configure():
    """A shell leaves what it starts with `&` deaf to Ctrl-C, `nohup` to a closed terminal, and so would be the commands that
    tests interrupt."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    sys.dont_write_bytecode = False  # the commands that tests start would all compile the package anew, half a second each
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)


@pytest.hookimpl(tryfirst=True)
def pytest_cmdline_main(config):
    """Folders of tests run in several processes where pytest-xdist is installed, a file in one; single files, --pdb and -n 0 in
    this one."""
    o, asked = config.option, getattr(config.option, "numprocesses", 0)
    if asked is None and "PYTEST_XDIST_WORKER" not in os.environ and any(map(os.path.isdir, config.args)) and not o.usepdb:
        o.numprocesses, o.dist, o.loadscopereorder = min(len(os.sched_getaffinity(0)), MOST), "loadfile", False
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # small systems: threads that wait take the cores of other processes
        first_kernels(config)


def first_kernels(config):
    """Start to compile what most processes need, into an empty cache. Taichi writes its cache at the end of a process, so the
    processes of the suite would compile it for themselves each, and so would the commands that they start."""
    from tehl_taichi.engine import runtime

    if runtime.has_kernels():
        return
    folder = tempfile.TemporaryDirectory()
    config.add_cleanup(folder.cleanup)
    os.environ[LOCK] = os.path.join(folder.name, "lock")
    with open(os.environ[LOCK], "w") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        subprocess.Popen([sys.executable, Path(__file__).with_name("first_kernels.py")], pass_fds=[held.fileno()],
                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@functools.cache
def take_first_kernels():
    """Once they are written, and by the same tables: Taichi knows a kernel by the number of its table."""
    from first_kernels import run

    with open(os.environ[LOCK]) as held:
        fcntl.flock(held, fcntl.LOCK_SH)
    run()


def tables_in_use():
    """Tables of solvers that live, or whose failed run is held by a reference cycle."""
    pool = sys.modules.get("tehl_taichi.engine.field_pool")
    return sum(owner() is not None for _, owner in pool._tables) if pool else 0


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol():
    """A run that failed leaves its tables to the next one, with the kernels that they have."""
    before = tables_in_use()
    try:
        return (yield)
    finally:
        if tables_in_use() > before:
            gc.collect()


def pytest_runtest_setup(item):
    if LOCK in os.environ and item.nodeid.startswith(SOLVERS):
        take_first_kernels()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """One process takes files from the front, where the kernels of the solvers are compiled, others take them from the back:
    most are compiled once."""
    if config.option.dist == "loadfile":
        from xdist.scheduler import LoadFileScheduling

        class BothEnds(LoadFileScheduling):
            def _assign_work_unit(self, node):
                if node is not self.nodes[0]:
                    self.workqueue.move_to_end(next(reversed(self.workqueue)), last=False)
                super()._assign_work_unit(node)

        return BothEnds(config, log)


def pytest_collection_modifyitems(items):
    """Files that compile the kernels of the solvers first, those of the criteria side by side; before them some that need no
    kernels, while the first ones are compiled."""
    items.sort(key=lambda item: [not item.nodeid.startswith(part) for part in (FIGURES, CRITERIA, KERNELS)])


def pytest_collection_finish():
    """Searches for garbage, of which every solver may ask for one, leave out the thousands of tests."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session", autouse=True)
def commands_once():
    """typer builds its commands at every call, 16 ms: some thousand calls of the tests share one tree."""
    import typer.main
    import typer.testing

    typer.main.get_command = typer.testing._get_command = functools.cache(typer.main.get_command)


@pytest.fixture(scope="session")
def taichi_cpu():
    """Taichi started once for the whole session, on two threads."""
    from tehl_taichi.engine import runtime

    return runtime.start(threads=2)


@pytest.fixture(autouse=True)
def figures_built_alone(request, monkeypatch):
    """Figures are built, but neither laid out nor rendered, 0.2 s each: files hold an empty one. Those of tests/view and of
    tests marked `rendered` are whole."""
    if request.node.nodeid.startswith("tests/view/") or request.node.get_closest_marker("rendered"):
        return
    style = importlib.import_module("tehl_taichi.view.figures.figure_style").FigureStyle
    save = style.save

    def empty(draw):
        from matplotlib.figure import Figure

        draw()
        return Figure((1, 1))

    monkeypatch.setattr(style, "save", lambda page, draw, path, of=None: save(page, lambda: empty(draw), path, of))


@pytest.fixture
def without_library(monkeypatch):
    """Reports without plotly.js, of which each takes 0.2 s to write."""
    document = importlib.import_module("tehl_taichi.report.document")
    monkeypatch.setattr(document, "library", lambda: document.pack("none"))


@pytest.fixture(params=("f32", "f64"))
def linear(request):
    """Changes of a scene for linear solves in single and in double precision."""
    return {"numerics.precision": request.param}


@pytest.fixture(scope="session")
def thermal(tmp_path_factory):
    """A finished run with temperatures and fatigue, made up."""
    import made_results

    return made_results.run(tmp_path_factory.mktemp("report") / "made.zarr", search=made_results.fatigue())
