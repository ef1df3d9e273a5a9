"""Kernels are traced from the very trees that Taichi itself would take, by fewer detours."""

import ast
import importlib
import inspect
import os
import pkgutil
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import tehl_taichi


def by_tokens(function):
    """The tree as Python's inspect finds it."""
    return ast.parse(textwrap.dedent("".join(inspect.getsourcelines(function)[0]))).body[0]


def functions():
    """All that run in kernels and stand in a module."""
    names = (module.name for module in pkgutil.walk_packages(tehl_taichi.__path__, "tehl_taichi."))
    found = (vars(importlib.import_module(name)).values() for name in names if not name.endswith("__main__"))
    return {entry.func.func for values in found for entry in values if getattr(entry, "_is_taichi_function", False)}


@pytest.fixture(scope="module")
def tracing(taichi_cpu):
    from tehl_taichi.engine.taichi_patches import fast_tracing

    return fast_tracing


def test_trees_are_those_of_inspect(tracing):
    found = functions()
    assert len(found) > 100
    assert [f.__qualname__ for f in found if ast.dump(tracing._node(f)) != ast.dump(by_tokens(f))] == []


def made():
    def last_lines(a,
                   b=(1,
                      2)):
        """Of several
        lines."""
        if a:
            return (
                a
            )
        else:
            pass
        return [
            b,
        ]

    def without_end(a):
        while True:
            a += 1

    return last_lines, without_end


@pytest.mark.parametrize("function", made(), ids=lambda f: f.__name__)
def test_odd_ends(tracing, function):
    """Brackets that close on lines of their own, a branch that does nothing."""
    assert ast.dump(tracing._node(function)) == ast.dump(by_tokens(function))


def test_another_function_in_its_place(tracing, monkeypatch):
    """A file that changed since it was imported."""
    function = made()[0]
    monkeypatch.setattr(tracing.linecache, "getlines", lambda name: ["def other():\n", "    return 1\n"] * 1000)
    tracing._node.cache_clear()
    assert tracing._node(function) is None
    tracing._node.cache_clear()


CODE = """
import numpy as np
from tehl_taichi.engine import runtime
runtime.start(threads=1)
from tehl_taichi.engine.language import ti

@ti.func
def power(x, n: ti.template()):
    y = ti.cast(1.0, ti.f64)
    for k in ti.static(range(n)):
        y = y * x if k % 2 == 0 else y / x * 2.5 * x
    return y

@ti.kernel
def fill(out: ti.types.ndarray(dtype=ti.f64, ndim=1)):
    for i in range(out.shape[0]):
        out[i] = min(power(i + 0.5, 3), 40) - (i // 2) % 3 + 2147483647 * 0.0

out = np.zeros(5)
fill(out)
print(out.tolist())
"""


def test_a_kernel_of_a_script_does_what_it_says(tmp_path):
    """As Taichi itself would have it (TEHL_DEBUG)."""
    script = tmp_path / "script.py"
    script.write_text(CODE)
    plain, kept = (subprocess.run([sys.executable, script], capture_output=True, text=True, env=env)
                   for env in (None, {**os.environ, "TEHL_DEBUG": "1"}))
    i = np.arange(5)
    assert eval(plain.stdout) == pytest.approx(np.minimum((i + 0.5) ** 2 * 2.5, 40) - (i // 2) % 3)
    assert plain.stdout == kept.stdout
