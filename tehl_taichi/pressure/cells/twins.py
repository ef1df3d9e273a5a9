"""The kernels of cells that stand for kernels of rows, and the arguments that they fill."""

from tehl_taichi.engine import field_pool
from tehl_taichi.engine.simd import W, get, put
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.pressure import active_sets, balances, isothermal_laws, reynolds, storage_term, tractions
from tehl_taichi.pressure.cells import kernels
from tehl_taichi.pressure.linear import transfer

KNOWN = {  # kernel: (its twin, numbers of the arguments that it fills); other packages add theirs
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
    """A launch of what stands for `kernel`, on the tables of `levels`."""
    twin, writes = KNOWN.get(kernel, (kernel, None))
    faces = (faces_of(levels),) if twin in (kernels.residual, kernels.linearise) else ()
    return bind(twin, *faces, *args, writes=writes)


def faces_of(levels):
    """The table of faces of `levels`."""
    if not hasattr(levels, "faces"):
        columns = levels.S.shape[1]
        levels.faces = field_pool.lease(levels, kernels.FACES, W, columns - field_pool.SKEW, clean=False)
    return levels.faces
