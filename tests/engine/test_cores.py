"""Cores that a process may use: affinity, quotas of containers, and threads that keep theirs."""

import json
import math
import os
import subprocess
import sys

import pytest

from tehl_taichi.engine import cores


def groups(tmp_path, line, **files):
    """A folder of control groups, and what this process would be told of its own."""
    for path, text in files.items():
        file = tmp_path / path.replace("__", "/").replace("cpu_max", "cpu.max").replace("cpu_cfs", "cpu.cfs")
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    own = tmp_path / "own"
    own.write_text(line)
    return tmp_path, own


@pytest.mark.parametrize("line,files,granted", [
    ("0::/job/step\n", {"job__cpu_max": "150000 100000\n", "job__step__cpu_max": "max 100000\n"}, 1.5),
    ("0::/\n", {"cpu_max": "50000 100000\n"}, 0.5),
    ("4:cpu:/box\n0::/\n", {"cpu__box__cpu_cfs_quota_us": "250000\n", "cpu__box__cpu_cfs_period_us": "100000\n"}, 2.5),
    ("4:cpu,cpuacct:/\n", {"cpu,cpuacct__cpu_cfs_quota_us": "-1\n", "cpu,cpuacct__cpu_cfs_period_us": "100000\n"}, math.inf),
    ("4:memory:/box\n", {"memory__box__cpu_max": "1 100000\n"}, math.inf),
])
def test_quota_of_control_groups(tmp_path, line, files, granted):
    assert cores.quota(*groups(tmp_path, line, **files)) == granted


def test_control_groups_are_read_once(tmp_path, monkeypatch):
    where, read = groups(tmp_path, "0::/\n", cpu_max="150000 100000\n"), []
    own = cores._granted
    monkeypatch.setattr(cores, "_granted", lambda folder: read.append(folder) or own(folder))
    assert [cores.quota(*where) for _ in range(3)] == [1.5] * 3 and len(read) == 1


def test_half_a_core_is_one_thread(tmp_path):
    assert cores.available(*groups(tmp_path, "0::/\n", cpu_max="50000 100000\n")) == 1


def test_no_control_groups(tmp_path):
    assert cores.quota(tmp_path, tmp_path / "none") == math.inf
    assert cores.available(tmp_path, tmp_path / "none") == len(cores.allowed())


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="affinity is Linux's")
@pytest.mark.parametrize("wanted", ["all", 1])
def test_threads_that_take_all_cores_keep_one_each(wanted):
    count = len(cores.allowed()) if wanted == "all" else 1
    code = f"""import contextlib, json, os
from tehl_taichi.engine import runtime
runtime.start(threads={count})
found = []
for task in os.listdir('/proc/self/task'):
    with contextlib.suppress(ProcessLookupError):  # a helper of Taichi that has ended since
        found.append(sorted(os.sched_getaffinity(int(task))))
print(json.dumps(found))"""
    found = json.loads(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
    alone = sorted(core for one in found if len(one) == 1 for core in one)
    assert alone == (cores.allowed() if count == len(cores.allowed()) > 1 else []) or len(cores.allowed()) == 1


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="affinity is Linux's")
def test_affinity_counts():
    code = ("import os; from tehl_taichi.engine import cores; os.sched_setaffinity(0, {cores.allowed()[-1]}); "
            "from tehl_taichi.engine import runtime; print(runtime.start()['threads'])")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "1"


def test_no_request_leaves_the_machine(tmp_path):
    """Taichi would ask for a newer version in a thread of its own, which was still at it when short programs ended."""
    code = ("from tehl_taichi.engine import runtime; import taichi._version_check as check; "
            "check.try_check_version = lambda: print('asked'); runtime.start()")
    own = {**os.environ, "HOME": str(tmp_path)}
    own.pop("TI_SKIP_VERSION_CHECK", None)
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=own).stdout == ""
