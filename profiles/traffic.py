"""Bytes that a kernel must at least move: each field that it names once, each array that it is given once."""

import inspect

import numpy as np

from tehl_taichi.engine.simd import W
from tehl_taichi.heat import film_tables
from tehl_taichi.march import extrapolation
from tehl_taichi.pressure import fields

# names in :mod:`tehl_taichi.pressure.fields`: of the linear problem (table J), and of the state (S)
IN_J = ("A", "AU", "AD", "B", "BU", "BD", "EPS", "SCALE", "KIND", "RES", "SOL", "COR", "TRIAL", "FILM", "BAND")
IN_S = ("P", "H", "GAP0", "QOLD", "MASK", "WEIGHT", "RHO", "LE", "IE", "ROOT", "GAP", "DLE", "DRP", "QP", "R", "D", "DRY",
        "TOUCH", "BASE", "RISE", "RHOC", "QCP", "SKEW", "DSKEW")
IN_Z = ("T", "TN", "TNN", "U", "VY", "MX", "MY", "MS", "MSN", "MSNN", "NIE", "NRHO", "TS", "PS", "LAST", "CAME", "CHANGED",
        "KEPT")  # per node of zeta; the last one stands for those of the viscosity
IN_C = ("PN", "PNN", "QA", "QB", "AA", "AB", "TAU", "PX", "PY", "XA", "YA", "XB", "YB", "PL", "HL", "STILL", "MOVING",
        "SA", "SB", "TURNED", "BENT", "STILLED")
CONSTANT = ("G", "blocks")  # arguments too small to count
# rows of the guesses' table that a kernel reads and writes: guesses of `order` orders in two frames, what they missed, states
OF_GUESSES = {extrapolation.extrapolate: lambda order: 3 * order + 1, extrapolation.judge: lambda order: 4 * order + 1,
              extrapolation.trust: lambda order: 4 * order}


def bytes_of(kernel, args):
    """Bytes of one launch of `kernel` with these arguments."""
    function = inspect.unwrap(kernel)
    given, names = dict(zip(inspect.signature(function).parameters, args)), _names(function)
    arrays = sum(value.nbytes for key, value in given.items() if isinstance(value, np.ndarray) and key not in CONSTANT)
    return int(arrays + _columns(given) * W * (_per_node(given, names) + _of_guesses(kernel, given)))


def _of_guesses(kernel, given):
    """Bytes at one node of the table F of a kernel of :mod:`tehl_taichi.march.extrapolation`, 0 of others."""
    return OF_GUESSES[kernel](given["order"]) * _bytes_of_a_number(given["F"]) if kernel in OF_GUESSES else 0


def _per_node(given, names):
    """Bytes of the tables' fields at one node; a field that is chosen by the arguments `row` or `rows` counts too."""
    nz = given["N"].shape[1] if "N" in given else given.get("nz", 1)
    chosen = (1 if "row" in given else 0) + len(given.get("rows", ()) if isinstance(given.get("rows"), tuple) else ())
    total = 8 * (_rows(fields, IN_S, names) + chosen) if "S" in given else 0
    total += _bytes_of_a_number(given["J"]) * _rows(fields, IN_J, names) if "J" in given else 0
    total += 8 * given["count"] if "modes" in given else 0  # of one body
    total += 8 * _rows(film_tables, IN_C, names) if "C" in given else 0
    return total + (8 * nz * _rows(film_tables, IN_Z, names) if "Z" in given else 0)


def _bytes_of_a_number(field):
    return {"f32": 4, "f64": 8}[str(field.dtype)]


def _rows(module, known, names):
    """Rows of a table that the names {name: value} stand for."""
    return sum(np.size(getattr(module, name)) for name in known if names.get(name) is getattr(module, name))


def _columns(given):
    """Lane vectors of a field that the loops run over: blocks first..last-1, the first `count` ones, or the finest level."""
    G = given.get("G")
    if G is None:
        return 0
    sizes = G[:, fields.NX] + 1
    if "blocks" in given:
        first, last = given.get("first", 0), given.get("last", given.get("count", given.get("solved")))
        return int(sum(sizes[level] for level, _ in given["blocks"][first:last]))
    return int(sizes[0] * (G[0, fields.NY] // W + 1))


def _names(function, seen=None):
    """{name: value} of the globals that a function and those it calls use."""
    seen = {} if seen is None else seen
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        if value is not None and name not in seen:
            seen[name] = value
            if inspect.isfunction(value):
                _names(inspect.unwrap(value), seen)
    return seen
