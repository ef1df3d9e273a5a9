"""Where Taichi can run: threads, forks, caches that cannot be written."""

import os
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

from tehl_taichi import scene
from tehl_taichi.engine import runtime
from tehl_taichi.errors import RuntimeUnavailable

SMALL = scene("smooth-line").replace(**{"thermal.on": False, "grid.nx": 64})
USES_A_KERNEL = """
import numpy as np
from tehl_taichi.fatigue.findley import smallest_circle
print(*smallest_circle(np.array([0.0, 2.0]), np.array([0.0, 0.0])))
"""


def first_film():
    from tehl_taichi.march.passage import march

    return next(march(SMALL)).scalars["h_c_m"]


@pytest.fixture
def no_cache_dir():
    runtime.cache_dir.cache_clear()
    yield
    runtime.cache_dir.cache_clear()


def test_a_second_thread_is_told_where_taichi_runs(taichi_cpu):
    found = []

    def work():
        try:
            found.append(first_film())
        except RuntimeUnavailable as error:
            found.append(str(error))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert "works only in the thread that started it" in found[0]


def test_other_threads_than_those_that_run_are_refused_before_anything_begins(taichi_cpu, tmp_path):
    import tehl_taichi as tehl

    steady = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    for begin in (lambda: tehl.run(steady, tmp_path / "run.zarr", threads=1),
                  lambda: tehl.sweep(steady, {"speed": [5.0]}, tmp_path / "sweep.zarr", workers=1, threads_per_worker=1),
                  lambda: tehl.flank("fzg-c", torque=265.1, folder=tmp_path / "flank", workers=1, threads=1)):
        with pytest.raises(RuntimeUnavailable, match="already runs with cpu, 2 threads"):
            begin()
    assert not list(tmp_path.iterdir())


NO_CARD = """
from tehl_taichi.engine import runtime
runtime.DRIVER = {driver!r}
try:
    runtime.start("cuda", 2)
except runtime.RuntimeUnavailable as error:
    print(error)
print(runtime.start("cpu", 2)["arch"])
"""


@pytest.mark.parametrize("driver, said", [("no-such-driver.so", "no driver"), (None, "no graphics card")])  # None: any library
def test_a_card_that_is_not_there_is_refused(driver, said):
    """Taichi itself would take the cores."""
    from tehl_taichi.engine.language import ti

    if ti.lang.misc.is_arch_supported(ti.cuda):
        pytest.skip("there is one")
    done = subprocess.run([sys.executable, "-c", NO_CARD.format(driver=driver)], capture_output=True, text=True)
    error, arch = done.stdout.splitlines()
    assert "'cuda' is not available" in error and said in error and arch == "cpu", done.stderr


def test_the_environment_chooses_where_no_arch_is_given(monkeypatch):
    monkeypatch.setattr(runtime, "_started", {})
    monkeypatch.delenv("TEHL_ARCH", raising=False)
    assert runtime.chosen() == "cpu"
    monkeypatch.setenv("TEHL_ARCH", "metal")
    assert (runtime.chosen(), runtime.chosen("cpu")) == ("metal", "cpu")
    with pytest.raises(RuntimeUnavailable, match="arch = 'metal' is not available"):
        runtime.check()
    monkeypatch.setattr(runtime, "_started", {"arch": "cpu", "threads": 2})
    assert runtime.chosen() == "cpu"


def test_a_forked_process_is_told_instead_of_waiting_for_ever(taichi_cpu):
    first_film()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12: fork with threads
        child = os.fork()
    if child == 0:
        code = 1
        try:
            first_film()
        except RuntimeUnavailable as error:
            code = 0 if "get_context('spawn')" in str(error) else 2
        finally:
            os._exit(code)
    assert wait_for(child, seconds=20) == 0


def wait_for(child, seconds):
    """Exit code of a child process, None if it had to be ended."""
    for _ in range(int(10 * seconds)):
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.1)
    os.kill(child, 9)
    os.waitpid(child, 0)
    return None


def test_a_cache_that_cannot_be_written_costs_a_warning_only(tmp_path):
    """Taichi dies with a segmentation fault at the end of such a process."""
    (tmp_path / "file").touch()
    environment = os.environ | {"TEHL_CACHE": str(tmp_path / "file"), "TMPDIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", USES_A_KERNEL], env=environment, capture_output=True, text=True)
    assert done.returncode == 0 and np.allclose([float(part) for part in done.stdout.split()], [1.0, 0.0, 1.0])
    assert done.stderr.count("Warning") == 1 and "TEHL_CACHE" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


SHORT_OF_ADDRESSES = """
import resource
import taichi
from tehl_taichi.disk import memory_limit
from tehl_taichi.engine import runtime

used = memory_limit._table(memory_limit.STATUS)["VmSize"]
resource.setrlimit(resource.RLIMIT_AS, (int(used + 5e8), resource.RLIM_INFINITY))
try:
    runtime.start(threads=1)
except runtime.RuntimeUnavailable as error:
    print(error)
"""


def test_a_start_without_enough_addresses_is_refused_in_a_sentence():
    done = subprocess.run([sys.executable, "-c", SHORT_OF_ADDRESSES], capture_output=True, text=True)
    said, = (line for line in done.stdout.splitlines() if "does not start" in line)
    assert said.endswith("it needs more than 1 GB of address space (`ulimit -v`)")


WORKERS = """
from tehl_taichi.engine import runtime
from tehl_taichi.runs.sweep import local_workers

print(*{answer["cache"] for _, answer in local_workers.results(runtime.start, ["cpu", "cpu"], 2)})
"""


def test_workers_share_the_folder_in_place_of_such_a_cache_and_leave_nothing(tmp_path):
    """They end at once, and would leave 3 MB each."""
    (tmp_path / "file").touch()
    environment = os.environ | {"TEHL_CACHE": str(tmp_path / "file"), "TMPDIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", WORKERS], env=environment, capture_output=True, text=True)
    assert done.returncode == 0 and done.stderr.count("Warning") == 1
    assert len(done.stdout.split()) == 1 and str(tmp_path) in done.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_process_that_leaves_at_once_has_written_its_kernels(tmp_path):
    ends = "import atexit; from tehl_taichi.engine import runtime; atexit.register(print, 'freed'); runtime.leave(9)"
    environment = os.environ | {"TEHL_CACHE": str(tmp_path)}
    nothing = subprocess.run([sys.executable, "-c", ends], env=environment, capture_output=True, text=True)
    assert (nothing.returncode, nothing.stdout) == (0, "freed\n") and not list(tmp_path.rglob("*.tic"))
    done = subprocess.run([sys.executable, "-c", USES_A_KERNEL + ends], env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (9, "") and "freed" not in done.stdout
    assert [float(part) for part in done.stdout.split()] == pytest.approx([1.0, 0.0, 1.0])
    kernels = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.tic")}
    assert kernels
    subprocess.run([sys.executable, "-c", USES_A_KERNEL + ends], env=environment, capture_output=True)
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.tic")} == kernels  # nothing was compiled again


def test_kernels_that_can_be_read_are_used(no_cache_dir, monkeypatch, tmp_path):
    monkeypatch.setenv("TEHL_CACHE", str(tmp_path))
    wanted = runtime.cache_dir()
    (wanted / "kernel").write_text("compiled")
    assert wanted == runtime.preferred_cache()
    runtime.cache_dir.cache_clear()

    def refuse(**_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(runtime.tempfile, "TemporaryFile", refuse)
    monkeypatch.setattr(runtime.atexit, "register", lambda *_: None)
    with pytest.warns(RuntimeWarning, match="cannot be kept in .*Permission denied"):
        other = runtime.cache_dir()
    assert other != wanted and (other / "kernel").read_text() == "compiled"
    runtime.shutil.rmtree(other.parent)


def test_the_fatigue_search_starts_taichi_itself(monkeypatch):
    from tehl_taichi.fatigue import findley

    started = []
    monkeypatch.setattr(runtime, "ensure", lambda: started.append(True))
    findley.smallest_circle(np.zeros(2), np.ones(2))
    with pytest.raises(ValueError):
        findley.search(np.zeros((1, 1)), 0.3)
    assert len(started) == 2


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="of the C library there")
def test_memory_that_comes_and_goes_stays_with_the_process():
    """Eight arrays of a megabyte, again and again: 40 000 pages from the system as it was."""
    told = """
import resource, numpy as np
from tehl_taichi.engine import runtime
runtime.start()
def pages(): return resource.getrusage(resource.RUSAGE_SELF).ru_minflt
def work(): return [np.ones(1 << 17) for _ in range(8)] and None
work()
before = pages()
for _ in range(20): work()
print(pages() - before)
"""
    assert int(subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=True).stdout) < 500
