"""A library call leaves the floating-point mode of its caller as it was: subnormal numbers are numbers."""

import subprocess
import sys

import numpy as np
import pytest

LARGEST = np.full(9, 1e-310)

CALLS = """
import threading
import numpy as np
import tehl_taichi as tehl
from tehl_taichi.errors import Error

def subnormal():
    return bool((np.full(9, 1e-310) * 0.5 > 0).all() and (np.full(9, 1e-40, "f4") * np.float32(0.5) > 0).all())

line = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
passage = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 2})
told = {"before": subnormal()}
for name, scene in (("abandoned", passage), ("thermal", passage.replace(**{"thermal.on": True, "time.steps": 1}))):
    steps = tehl.march(scene)
    told[name + ", made"] = subnormal()
    next(steps)
    told[name + ", a step"] = subnormal()
    next(steps)
    told[name + ", two"] = subnormal()
    del steps
    told[name] = subnormal()
try:
    list(tehl.march(line.replace(**{"numerics.newton_max": 1, "numerics.krylov_max": 5})))
except Error:
    told["failed"] = subnormal()
run = tehl.run(passage, "a.zarr", threads=THREADS)
told["run"] = subnormal()
run.fatigue(kappa=0.2)
told["run.fatigue"] = subnormal()
tehl.fatigue(np.ones((3, 6)) * [[1e8], [-1e8], [0]])
told["fatigue"] = subnormal()
try:
    run.crack(length=10e-6)
except Error:
    pass
told["crack"] = subnormal()
tehl.sweep(line, {"srr": [0.0, 0.1]}, "s.zarr", workers=1)
told["sweep"] = subnormal()
seen = []
thread = threading.Thread(target=lambda: seen.append(subnormal()))
thread.start()
thread.join()
told["a thread of the caller"] = seen[0]
print({name: kept for name, kept in told.items() if not kept}, len(told))
"""


@pytest.mark.slow
def test_every_call_leaves_subnormal_numbers(taichi_cpu, tmp_path, monkeypatch, capsys):
    """In this process, where kernels of other tests serve."""
    monkeypatch.chdir(tmp_path)
    exec(compile(CALLS.replace("THREADS", "None"), "calls", "exec"), {})
    assert capsys.readouterr().out.strip() == "{} 16"


def test_a_start_leaves_subnormal_numbers():
    code = ("import numpy as np; from tehl_taichi.engine import runtime; runtime.start(threads=2); "
            "print((np.full(9, 1e-310) * 0.5 > 0).all())")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "True\n"


@pytest.mark.slow
@pytest.mark.parametrize("threads", [1, 2])
def test_every_call_of_a_new_process_leaves_subnormal_numbers(tmp_path, threads):
    code = CALLS.replace("THREADS", "None").replace("import threading\n", (
        f"import threading\nfrom tehl_taichi.engine import runtime\nruntime.start(threads={threads})\n"), 1)
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.stdout.strip().endswith("{} 16"), done.stdout + done.stderr[-2000:]


def test_kernels_keep_their_mode():
    """That in which their threads are: the bits must not depend on who runs a loop."""
    from tehl_taichi.engine import runtime
    from tehl_taichi.engine.language import ti
    from tehl_taichi.engine.taichi_patches.prebound import bind

    runtime.ensure()

    @ti.kernel
    def halve(values: ti.types.ndarray(dtype=ti.f64, ndim=1)):
        for i in range(values.shape[0]):
            values[i] = values[i] * 0.5

    plain, bound = LARGEST.copy(), LARGEST.copy()
    halve(plain)
    bind(halve, bound)()
    assert (plain == 0).all() and (bound == 0).all() and (LARGEST * 0.5 > 0).all()


def test_a_launch_that_fails_leaves_it_too():
    from tehl_taichi.engine import float_mode

    class Program:
        def launch_kernel(self, fails):
            assert not (LARGEST * 0.5 > 0).any()
            if fails:
                raise ValueError

    from tehl_taichi.engine import runtime

    runtime.ensure()
    float_mode.launching(Program(), _flushing())
    Program().launch_kernel(False)
    with pytest.raises(ValueError):
        Program().launch_kernel(True)
    assert (LARGEST * 0.5 > 0).all()


def _flushing():
    """The mode of x86-64 with FTZ and DAZ set (the last word of its fenv_t)."""
    from tehl_taichi.engine import float_mode

    mode = float_mode.now()
    mode[28:30] = (int.from_bytes(mode[28:30], "little") | 0x8040).to_bytes(2, "little")
    return mode
