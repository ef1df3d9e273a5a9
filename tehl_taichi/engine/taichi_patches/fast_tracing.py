"""Faster tracing of kernels: Taichi's repeated requests to Python, and data that only its messages need, are left out.

Every function is traced again wherever it is called: 1700 functions, 95 000 syntax nodes and 80 000 expressions before the
first step of a thermal run, so small costs add up. Of 1.25 s of a core before that step (kernels in the cache), extracting
functions by their code saves 0.14, making expressions directly 0.1. Earlier savings in a coarse run (64x16): reading and
splitting the source of a function at every call in a kernel, 0.6 s; parsing it, 0.3; the position of every node (Findley search
alone 2.9 -> 1.2), for messages that only developers see: TEHL_DEBUG=1 keeps it all.
"""

import ast
import functools
import linecache
import textwrap

KNOWN = (1, 7, 4)  # the Taichi whose tracing this is
INT32 = range(-(2**31), 2**31)


@functools.cache
def _node(function):
    """Syntax tree of a function, None if its file no longer contains it."""
    code = function.__code__
    last = max((end for _, end, _, _ in code.co_positions() if end), default=0)
    lines = linecache.getlines(code.co_filename)[code.co_firstlineno - 1 : last]
    try:
        node = ast.parse(textwrap.dedent("".join(lines))).body[0]
    except (IndexError, SyntaxError):
        return None
    return node if getattr(node, "name", "") == code.co_name else None


def _headless(node):
    """Module with a function without its decorators; its body is shared with earlier ones, since Taichi empties its
    arguments.
    """
    head = {**vars(node), "args": ast.arguments(**vars(node.args)), "decorator_list": []}
    return ast.Module(body=[ast.FunctionDef(**head)], type_ignores=[])


def trees():
    """Patch: take the source lines of a function from its code object, without a token search, and parse them once."""
    from taichi.lang import kernel_impl

    own, names_of, context = kernel_impl._get_tree_and_ctx, kernel_impl._get_global_vars, kernel_impl.ASTTransformerContext

    def tree_and_context(self, excluded_parameters=(), is_kernel=True, arg_features=None, args=None, ast_builder=None,
                         is_real_function=False):
        node = _node(self.func)
        if node is None:
            return own(self, excluded_parameters, is_kernel, arg_features, args, ast_builder, is_real_function)
        names = names_of(self.func)
        if is_kernel or is_real_function:
            names |= {self.arguments[slot].name: args[slot] for slot in self.template_slot_locations}
        return _headless(node), context(
            excluded_parameters=excluded_parameters, is_kernel=is_kernel, func=self, arg_features=arg_features,
            global_vars=names, argument_data=args, src=[""], start_lineno=1, file="", ast_builder=ast_builder,
            is_real_function=is_real_function)

    kernel_impl._get_tree_and_ctx = tree_and_context


def nodes():
    """Patch: look up the method that builds a kind of node once, and no positions."""
    from taichi.lang.ast.ast_transformer import ASTTransformer
    from taichi.lang.ast.ast_transformer_utils import ASTTransformerContext, Builder
    from taichi.lang.impl import PyTaichi

    assert callable(ASTTransformerContext.get_pos_info) and callable(PyTaichi.get_current_src_info)
    own = Builder.__call__

    @functools.cache
    def method(kind):
        return getattr(ASTTransformer, "build_" + kind.__name__, None)

    def call(builder, context, node):
        build = method(node.__class__)
        return build(context, node) if build and not context.raised else own(builder, context, node)

    ASTTransformerContext.get_pos_info = lambda context, node: ""
    PyTaichi.get_current_src_info = lambda runtime: ""
    Builder.__call__ = call


def expressions():
    """Patch: make expressions, variables and whole numbers directly, without source positions for messages."""
    from taichi.lang import expr, impl

    core, Expr = impl._ti_core, expr.Expr
    place, own, constant, variable = core.DebugInfo(""), Expr.__init__, expr.make_constant_expr, impl.expr_init

    def init(self, *args, dbg_info=None, dtype=None):
        if type(args[0]) is not core.Expr:
            return own(self, *args, dtype=dtype)
        self.dbg_info, self.ptr, self.ptr_type_checked = None, args[0], True
        self.ptr.type_check(impl.get_runtime().prog.config())

    def make_constant_expr(value, dtype):
        if type(value) is int and dtype is None and value in INT32:
            return Expr(core.make_const_expr_int(impl.get_runtime().default_ip, value))
        return constant(value, dtype)

    def expr_init(value):
        if type(value) is not Expr:
            return variable(value)
        return Expr(impl.get_runtime().compiling_callable.ast_builder().expr_var(value.ptr, place))

    core.DebugInfo = lambda *args: place
    Expr.__init__, expr.make_constant_expr, impl.expr_init = init, make_constant_expr, expr_init
