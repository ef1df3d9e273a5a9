"""Kernels are called with the arguments that Taichi's own call would give them."""

import numpy as np
import pytest

from tehl_taichi.engine.language import ti


@pytest.fixture(scope="module")
def launch(taichi_cpu):
    from taichi.lang.kernel_impl import Kernel

    return Kernel.launch_kernel


@pytest.fixture(scope="module")
def kernels(launch):
    pair = ti.types.vector(2, ti.f64)

    @ti.kernel
    def put(out: ti.types.ndarray(dtype=ti.f64, ndim=2), n: ti.i32, x: ti.f64, twice: ti.template()):
        for i, j in out:
            out[i, j] = 10 * i + j + n + x * (2 if ti.static(twice) else 1)

    @ti.kernel
    def turn(out: ti.types.ndarray(dtype=pair, ndim=1)):
        for i in out:
            out[i] = pair(out[i][1], out[i][0] + i)

    @ti.kernel
    def total(values: ti.types.ndarray(dtype=ti.f64, ndim=1)) -> ti.f64:
        out = 0.0
        for i in range(values.shape[0]):
            out += values[i]
        return out

    return put, turn, total


@pytest.fixture(params=["fast", "own"])
def way(request, launch, monkeypatch):
    """Both ways of a call; gives whether it is that of the patch."""
    from taichi.lang.kernel_impl import Kernel

    if request.param == "own":
        monkeypatch.setattr(Kernel, "launch_kernel", launch.own)
    return request.param == "fast"


def expected(n, x, rows=3):
    return 10.0 * np.arange(rows)[:, None] + np.arange(4) + n + x


@pytest.mark.parametrize("n, x", [(1, 0.5), (np.int64(2), np.float32(0.25)), (True, 3), (np.int32(1), np.int64(7))])
def test_numbers_of_every_kind(kernels, way, n, x):
    out = np.zeros((3, 4))
    kernels[0](out, n, x, False)
    assert np.array_equal(out, expected(int(n), float(x)))
    kernels[0](out, n, x, True)
    assert np.array_equal(out, expected(int(n), 2 * float(x)))


def test_arrays_of_every_layout(kernels, way):
    turned, empty = np.zeros((3, 4), order="F"), np.zeros((0, 4))
    kernels[0](turned, 1, 0.0, False)
    kernels[0](empty, 1, 0.0, False)
    assert np.array_equal(turned, expected(1, 0.0))
    with pytest.raises(Exception, match="Non contiguous"):
        kernels[0](np.zeros((3, 8))[:, ::2], 1, 0.0, False)
    pairs = np.arange(6.0).reshape(3, 2)
    kernels[1](pairs)
    assert pairs.tolist() == [[1, 0], [3, 3], [5, 6]]


def test_wrong_arguments_are_refused(kernels, way):
    for wrong in ((np.zeros((3, 4)), 1.5, 0.0, False), (np.zeros((3, 4)), 1, "x", False), (np.zeros(3), 1, 0.0, False),
                  (np.zeros((3, 4), "f4"), 1, 0.0, False), (np.zeros((3, 4)), 1, 0.0)):
        with pytest.raises(Exception, match="rgument|dtype|ndim|dimension|missing"):
            kernels[0](*wrong)


def test_results_come_back(kernels, way):
    assert kernels[2](np.arange(4.0)) == 6.0


def test_calls_are_those_of_the_patch(kernels, launch, monkeypatch):
    """So the tests above have compared two ways."""
    kernels[0](np.zeros((3, 4)), 1, 0.0, False)
    assert len(kernels[0]._primal.setters) == 3 and kernels[2]._primal.setters is None
    used = []
    monkeypatch.setattr(kernels[0]._primal, "setters", [(n, lambda *of, s=s: used.append(of[1]) or s(*of))
                                                        for n, s in kernels[0]._primal.setters])
    kernels[0](np.zeros((3, 4)), 1, 0.0, False)
    assert used == [(0,), (1,), (2,)]
