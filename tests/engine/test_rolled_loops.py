"""Loops in kernels that LLVM is kept from unrolling do what loops do."""

import numpy as np
import pytest


@pytest.fixture(scope="module")
def kernels(taichi_cpu):
    from tehl_taichi.engine.language import ti

    Numbers = ti.types.ndarray(dtype=ti.i32, ndim=2)

    @ti.func
    def inner(out: ti.template(), row, n):
        count = 0
        for i in range(n):
            count += i
        out[row, 0] = count

    @ti.kernel
    def loops(out: Numbers, begin: ti.i32, end: ti.i32):
        for row in range(out.shape[0]):
            inner(out, row, end)
            for i in range(begin, end):
                out[row, 1] += 1
                if i == 5:
                    break
            for i in range(begin, end):
                if i % 2 == 0:
                    continue
                for k in range(i):
                    out[row, 2] += k
            last = end
            for _ in range(last):
                last -= 1  # the number of turns is that of the beginning
                out[row, 3] += last
            for i in range(3):
                out[row, 4] += i

    return loops


def by_python(begin, end):
    upto = [i for i in range(begin, end)]
    return [sum(range(end)), len(upto[: upto.index(5) + 1] if 5 in upto else upto),
            sum(sum(range(i)) for i in upto if i % 2), sum(end - 1 - i for i in range(end)), 3]


@pytest.mark.parametrize("begin, end", ((0, 9), (3, 4), (4, 4), (7, 2), (-3, 6), (0, 100)))
def test_loops_in_loops(kernels, begin, end):
    out = np.zeros((3, 5), np.int32)
    kernels(out, begin, end)
    assert out.tolist() == [by_python(begin, end)] * 3


def test_the_code_of_a_loop_has_no_copies(taichi_cpu, tmp_path):
    """In the compiled kernel, which Taichi keeps as text, the body of a loop stands once: LLVM would repeat it."""
    import os
    import subprocess
    import sys

    program = tmp_path / "program.py"
    program.write_text("""
import numpy as np
from tehl_taichi.engine import runtime
runtime.start(threads=1)
from tehl_taichi.engine.language import ti

@ti.kernel
def marked(out: ti.types.ndarray(dtype=ti.i32, ndim=2), n: ti.i32):
    for row in range(out.shape[0]):
        for i in range(n):
            out[row, i] = out[row, i] * 7654321

marked(np.ones((2, 50), np.int32), 50)
ti.reset()
""")
    subprocess.run([sys.executable, program], env={**os.environ, "TEHL_CACHE": str(tmp_path)}, check=True)
    found = [code.count(b"7654321") for code in (file.read_bytes() for file in tmp_path.rglob("*.tic"))]
    assert max(found) == 1
