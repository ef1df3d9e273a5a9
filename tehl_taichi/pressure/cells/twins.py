"""Kernels for graphics cards (one column per job) that replace kernels for processors, and the arguments that they write."""

from tehl_taichi.engine import field_pool
from tehl_taichi.engine.simd import W, get, put
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.pressure import active_sets, balances, isothermal_laws, reynolds, storage_term, tractions
from tehl_taichi.pressure.cells import kernels
from tehl_taichi.pressure.linear import transfer

KNOWN = {  # kernel: (its twin, numbers of the arguments that the twin writes); other rooms may add theirs
    put: (kernels.put, ()),
    get: (kernels.get, (4,)),
    balances.save: (kernels.save, (3,)),
    balances.advance: (kernels.advance, ()),
    balances.choose_sets: (kernels.choose_sets, (4, 5, 6)),
    isothermal_laws.laws: (kernels.laws, ()),
    reynolds.residual: (kernels.residual, ()),
    reynolds.linearise: (kernels.linearise, ()),
    reynolds.contact_right: (kernels.contact_right, (3,)),
    transfer.inject: (kernels.inject, ()),
    active_sets.replace_rows: (kernels.replace_rows, ()),
    storage_term.follow: (kernels.follow, ()),
    storage_term.keep: (kernels.keep, ()),
    tractions.tractions: (kernels.tractions, (4,)),
}


def launch(levels, kernel, *args):
    """Bound launch of the twin of `kernel` (or of `kernel` itself without a twin), on the tables of `levels`."""
    twin, writes = KNOWN.get(kernel, (kernel, None))
    faces = (faces_of(levels),) if twin in (kernels.residual, kernels.linearise) else ()
    return bind(twin, *faces, *args, writes=writes)


def faces_of(levels):
    """Table of faces of `levels`, made at the first call."""
    if not hasattr(levels, "faces"):
        columns = levels.S.shape[1]
        levels.faces = field_pool.lease(levels, kernels.FACES, W, columns - field_pool.SKEW, clean=False)
    return levels.faces
