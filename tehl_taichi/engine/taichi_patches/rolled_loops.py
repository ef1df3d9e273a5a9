"""Loops inside kernels that LLVM does not unroll: it would make up to eight copies of each, and a remainder, and then try
cheaper addresses for all of them (loop strength reduction), at every start of a program.

LLVM unrolls loops with a known count, so these advance by an unknown step: one plus a field that holds zero. `llc -O3` on the
cached code of the linear solve 1.72 -> 0.75 s; the first step of a warm isothermal run 6.0 -> 2.7 s, with temperatures 10 ->
5.5 s; without cache 20 -> 8 and 29 -> 16 s. Kernels are as fast, that of the energy faster (12.3 -> 9 ms).
"""

import ast
from contextlib import contextmanager

from tehl_taichi.engine.language import ti

USED = ("begin_frontend_while", "begin_frontend_if_true", "begin_frontend_if_false", "insert_break_stmt", "pop_scope",
        "expr_assign")  # of Taichi's builder
_depth = 0  # loops that are open now in the kernel that is traced; the outermost is Taichi's own, which runs on all threads


def keep_rolled():
    """Keep the loops of all further kernels of the program rolled. Raises AttributeError, ImportError or AssertionError,
    without any change, if Taichi differs from the expected version.
    """
    from taichi.lang import impl
    from taichi.lang.ast.ast_transformer import ASTTransformer

    assert callable(impl.begin_frontend_if) and all(hasattr(impl._ti_core.ASTBuilder, name) for name in USED)
    nothing = ti.field(ti.i32, shape=())
    own = getattr(ASTTransformer.build_range_for, "own", ASTTransformer.build_range_for)

    def build_range_for(ctx, node):
        constant = all(isinstance(argument, ast.Constant) for argument in node.iter.args)  # a few: LLVM may have them
        with _deeper() as outermost:
            return own(ctx, node) if outermost or constant else _while(ctx, node, nothing)

    build_range_for.own = own
    ASTTransformer.build_range_for = staticmethod(build_range_for)


@contextmanager
def _deeper():
    """Context manager: count the depth of loops; gives whether this loop is the outermost."""
    global _depth
    _depth += 1
    try:
        yield _depth == 1
    finally:
        _depth -= 1


def _while(ctx, node, nothing):
    """Build `for NAME in range(...)` as: NAME = begin - step; while NAME < end - step: NAME += step; ..."""
    from taichi.lang import expr, impl
    from taichi.lang.ast.ast_transformer import build_stmt, build_stmts

    def number(value):
        return ti.cast(expr.Expr(value), ti.i32)

    with ctx.variable_scope_guard():
        name, builder = node.target.id, ctx.ast_builder
        ctx.check_loop_var(name)
        bounds = [number(build_stmt(ctx, argument)) for argument in node.iter.args]
        begin, end = bounds if len(bounds) == 2 else (number(0), *bounds)
        step = impl.expr_init(impl.subscript(builder, nothing, None) + 1)
        last, variable = impl.expr_init(end - step), impl.expr_init(begin - step)
        ctx.create_variable(name, variable)
        where = impl._ti_core.DebugInfo(ctx.get_pos_info(node))
        builder.begin_frontend_while(number(1).ptr, where)
        impl.begin_frontend_if(builder, variable < last, where)
        builder.begin_frontend_if_true()
        builder.pop_scope()
        builder.begin_frontend_if_false()
        builder.insert_break_stmt(where)
        builder.pop_scope()
        builder.expr_assign(variable.ptr, (variable + step).ptr, where)
        build_stmts(ctx, node.body)
        builder.pop_scope()
