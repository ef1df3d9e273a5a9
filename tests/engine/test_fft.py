"""Fourier transforms inside kernels against numpy's."""

import numpy as np
import pytest

from tehl_taichi.engine import fft
from tehl_taichi.engine.fft import fast_length, radices
from tehl_taichi.engine.field_pool import lease
from tehl_taichi.engine.language import ti

LENGTHS = (1, 2, 3, 4, 5, 6, 8, 12, 15, 16, 30, 36, 45, 50, 64, 100, 128, 240, 270)
ACCURACY = {"f32": 1e-6, "f64": 1e-15}


@pytest.fixture(scope="module", params=("f32", "f64"))
def transformed(request, taichi_cpu):
    """(length, numbers) -> their transform: a function (length, backward, x) -> complex (length, 4), and its accuracy."""
    lengths, owner = fft.Lengths(), type("owner", (), {})()
    places = {n: lengths.place(n) for n in LENGTHS}
    Q, w, odd = lengths.table(), lengths.twiddles(), fft.odd_radices(lengths)
    B, T = lease(owner, 1, 4, 2000, precision=request.param), lease(owner, 1, 2, len(w), precision=request.param)
    w = np.pad(w, ((0, T.shape[1] - len(w)), (0, 0)))
    T.from_numpy(w[None].astype(B.to_numpy().dtype))

    @ti.kernel
    def run(B: ti.template(), T: ti.template(), Q: fft.Passes, row: ti.i32, rows: ti.i32, backward: ti.i32) -> ti.i32:
        found = 0
        for _ in range(1):
            found = fft.transform(B, 7, 1007, T, Q, odd, row, rows, backward)
        return found

    def transform(n, backward, x):
        values = np.zeros((1, B.shape[1], 4))
        values[0, 7 : 7 + 2 * n] = np.stack([x.real, x.imag], 1).reshape(2 * n, 4)
        B.from_numpy(values.astype(B.to_numpy().dtype))
        first = run(B, T, Q, *places[n], backward)
        out = B.to_numpy()[0, first : first + 2 * n].astype(float)
        return out[0::2] + 1j * out[1::2]

    transform.owner = owner  # the tables are its as long as it lives
    return transform, ACCURACY[request.param]


@pytest.mark.parametrize("n", LENGTHS)
def test_transforms_are_those_of_numpy(transformed, n):
    transform, accuracy = transformed
    rng = np.random.default_rng(n)
    x = rng.standard_normal((n, 4)) + 1j * rng.standard_normal((n, 4))
    for backward, exact in ((0, np.fft.fft(x, axis=0)), (1, n * np.fft.ifft(x, axis=0))):
        assert np.abs(transform(n, backward, x) - exact).max() < accuracy * 4 * np.abs(exact).max()


def test_fast_lengths():
    assert [fast_length(n) for n in (1, 7, 11, 17, 31, 97, 257)] == [1, 8, 12, 18, 32, 100, 270]
    assert all(np.prod(radices(n)) == n and set(radices(n)) <= {2, 3, 4, 5} for n in LENGTHS)
