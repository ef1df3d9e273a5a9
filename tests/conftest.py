import importlib
import os
import signal
import sys

import pytest

MOST = 4  # processes of the whole suite: each needs 1.5 GB
KERNELS = ("tests/march/", "tests/heat/", "tests/pressure/")  # that mostly compile the same ones


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


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """One of two processes compiles the kernels of the solvers, which take longest, and the other one does the rest; of more
    processes each has its files."""
    if config.option.dist == "loadfile" and config.option.numprocesses == 2:
        from xdist.scheduler import LoadFileScheduling

        class Rooms(LoadFileScheduling):
            def _split_scope(self, nodeid):
                return "kernels" if nodeid.startswith(KERNELS) else super()._split_scope(nodeid)

        return Rooms(config, log)


def pytest_collection_modifyitems(items):
    """The longest part first."""
    items.sort(key=lambda item: [item.nodeid.startswith(room) for room in KERNELS], reverse=True)


@pytest.fixture(scope="session")
def taichi_cpu():
    """Taichi started once for the whole session, on two threads."""
    from tehl_taichi.engine import runtime

    return runtime.start(threads=2)


@pytest.fixture
def without_library(monkeypatch):
    """Reports without plotly.js, of which each takes 0.2 s to write."""
    document = importlib.import_module("tehl_taichi.report.document")
    monkeypatch.setattr(document, "library", lambda: document.packed("none"))


@pytest.fixture(params=("f32", "f64"))
def linear(request):
    """Changes of a scene for linear solves in single and in double precision."""
    return {"numerics.precision": request.param}


@pytest.fixture(scope="session")
def thermal(tmp_path_factory):
    """A finished run with temperatures and fatigue, made up."""
    import made_results

    return made_results.run(tmp_path_factory.mktemp("report") / "made.zarr", search=made_results.fatigue())
