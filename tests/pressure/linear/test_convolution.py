"""Deflection and distribution inside the kernel of the linear solve: against numpy, for every kind of contact."""

import numpy as np
import pytest
from direct_deflection import deflected

from tehl_taichi.engine import simd
from tehl_taichi.engine.task_pool import PATIENCE
from tehl_taichi.pressure import fields, influence
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.linear import line_solver, schedule
from tehl_taichi.pressure.linear.solver import Krylov
from tehl_taichi.scene import scene

ACCURACY = {"f32": 1e-6, "f64": 1e-14}  # of the largest value; transforms by FFTW in single precision: 3e-7
# scene, cells, whole domain; 112 and 28 have a factor 7 and need longer transforms
CASES = {"line": ("gear", 64, 16, False), "line, odd lengths": ("gear", 112, 28, False),
         "whole line": ("gear", 64, 32, True), "profile": ("smooth-line", 128, 0, False),
         "circle": ("ball-on-disc", 64, 32, False),
         "whole circle": ("ball-on-disc", 32, 32, True),
         "ellipse": ("", 112, 28, False), "whole ellipse": ("", 48, 20, True)}


# other radices in single precision are slow: the kernel is that of double precision, of which each has a quick one
QUICK = [pytest.param(name, precision, id=f"{name}-{precision}",
                      marks=[pytest.mark.slow] * (precision == "f32" and (112 in case or 48 in case)))
         for name, case in CASES.items() for precision in ACCURACY]


def levels_of(name, precision):
    builtin, nx, ny, full = CASES[name]
    ellipse = {"contact.kind": "elliptic", "contact.radius_y": 40e-3} if "ellipse" in name else {}
    cells = {"grid.nx": nx, "grid.ny": ny} if ny else {"grid.nx": nx}
    description = scene("ball-on-disc" if ellipse else builtin).replace(
        **{**ellipse, **cells, "thermal.on": False, "numerics.precision": precision})
    return Levels(description, nx, ny, full)


def of_table(levels, table, row, l=0):
    """Field of J as (ny+1, nx+1)."""
    nx, ny = levels.sizes[l]
    first, blocks = int(levels.G[l, fields.OFF]), ny // simd.W + 1
    found = table.to_numpy()[row, first : first + blocks * (nx + 1)].astype(float)
    return found.reshape(blocks, nx + 1, simd.W).transpose(0, 2, 1).reshape(-1, nx + 1)[: ny + 1]


@pytest.mark.parametrize("name, precision", QUICK)
def test_deflection(taichi_cpu, name, precision):
    """And a rise of H0 on top of it: of a linear solve in its precision, and of the film in double precision."""
    levels = levels_of(name, precision)
    krylov = Krylov(levels)
    levels.put(fields.P, np.random.default_rng(3).random((levels.ny + 1, levels.nx + 1)))
    levels.put(fields.P, levels.get(fields.P) * levels.get(fields.MASK))
    krylov.apply(levels.vector(fields.P), 0.25)
    exact = deflected(levels.get(fields.P), *levels.deflection_key(0)[2:]) + 0.25
    assert np.abs(of_table(levels, levels.J, fields.FILM) - exact).max() < ACCURACY[precision] * np.abs(exact).max()
    gap = np.random.default_rng(5).random(exact.shape)
    levels.put(fields.GAP0, gap)
    levels.set_film(0.25)
    assert np.abs(levels.get(fields.H) - gap - exact).max() < ACCURACY["f64"] * np.abs(exact).max()


@pytest.mark.parametrize("size, patience", ((2, 10**6), (2, 0), (7, 10**4)))
def test_the_same_film_by_any_number_of_workers(taichi_cpu, size, patience):
    levels, films = levels_of("whole circle", "f64"), []
    levels.put(fields.P, np.random.default_rng(6).random((levels.ny + 1, levels.nx + 1)))
    team = levels.bending.team
    for team.size, team.sync[PATIENCE] in ((1, 10**6), (size, patience)):
        team.alone = 0
        levels.set_film(0.5)
        films.append(levels.get(fields.H).tobytes())
    assert films[0] == films[1]


def waves(levels, shape):
    """Symbol of K^-1 on a whole period, (2 further, 2 M)."""
    further = shape.further if levels.ny else 0
    symbol = 1 / influence.symbol(2 * shape.M, further, *levels.grid(0)[2:], levels.scales.compliance)
    symbol = np.hstack([symbol, symbol[:, -2:0:-1]])
    return np.vstack([symbol, symbol[-2:0:-1]]) if further else symbol


@pytest.mark.parametrize("name, precision", QUICK)
def test_distribution(taichi_cpu, name, precision):
    """Between line solutions that are the right-hand side, and corrections that are what comes back."""
    levels = levels_of(name, precision)
    krylov = Krylov(levels)
    simd.put(levels.J, levels.G, 0, fields.BAND[line_solver.HALF], np.ones((levels.ny + 1, levels.nx + 1)), True)
    values = np.random.default_rng(4).random((levels.ny + 1, levels.nx + 1))
    for row, numbers in ((fields.KIND, 0 * values + line_solver.DISTRIBUTED), (fields.RES, values)):
        simd.put(levels.J, levels.G, 0, row, numbers, True)
    todo = krylov.program.phases
    first = next(n for n, phase in enumerate(todo) if krylov.program.jobs[phase[schedule.FIRST_JOB], 0] == schedule.LINES)
    todo[first + 2, schedule.DECISION] = schedule.END
    krylov._run(first)
    shape = krylov.symbols[1].shape
    exact = distributed(values, waves(levels, shape))[: levels.ny + 1, np.arange(levels.nx + 1) % (2 * shape.M)]
    assert np.abs(of_table(levels, levels.J, fields.COR) - exact).max() < ACCURACY[precision] * np.abs(exact).max()


def distributed(values, symbol):
    """The symbol applied to rows that are mirrored at y = 0, periodic along x."""
    whole = np.zeros(symbol.shape)
    rows = values[:, : symbol.shape[1]]
    whole[: len(rows), : rows.shape[1]] = rows
    for j in range(1, min(len(rows), len(whole) - len(rows) + 1)):
        whole[-j, : rows.shape[1]] = rows[j]
    return np.fft.ifft2(np.fft.fft2(whole) * symbol).real


@pytest.mark.parametrize("name", CASES)
def test_near_distribution(taichi_cpu, name):
    """What a unit in row 0 causes there and in the next row."""
    levels = levels_of(name, "f64")
    from tehl_taichi.pressure.linear import convolution

    shape = convolution.transform_sizes(levels.sizes, levels.lines)[1]
    unit = np.zeros((1, 2 * shape.M))
    unit[0, 0] = 1.0
    exact = distributed(unit, waves(levels, shape))[:2, :8]
    found = convolution.distribution(shape, levels).near(8)
    assert np.abs(found[: len(exact)] - exact).max() < 1e-13 * np.abs(exact).max()
