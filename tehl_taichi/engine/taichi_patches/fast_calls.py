"""Faster calls of kernels whose arguments are numbers, contiguous arrays and fields: the kind of each argument is found once
for a kernel, not at every call. A steady case of a study has 58 such calls, of 5 to 14 arguments.
"""

import numpy as np

MOST = 64  # arguments: more are refused by Taichi's own call
INTEGERS, REALS = (int, np.integer), (float, int, np.floating, np.integer)


def calls():
    """Patch: set the arguments of such kernels directly. Raises AttributeError, ImportError or AssertionError, without any
    change, if Taichi differs from the expected version.
    """
    from taichi.lang import impl, kernel_impl
    from taichi.lang.enums import Layout
    from taichi.lang.util import cook_dtype
    from taichi.types import ndarray_type, primitive_types
    from taichi.types.annotations import template
    from taichi.types.utils import is_signed

    own, in_words, get_runtime = kernel_impl.Kernel.launch_kernel, kernel_impl.handle_exception_from_cpp, impl.get_runtime
    assert callable(own) and callable(in_words) and callable(get_runtime)

    def setter_of(annotation):
        """Function of (record, slot, value) that sets an argument and returns whether it could; None for another kind."""
        if id(annotation) in primitive_types.real_type_ids:
            return _set_real
        if id(annotation) in primitive_types.integer_type_ids:
            return _set_integer if is_signed(cook_dtype(annotation)) else None
        if not isinstance(annotation, ndarray_type.NdarrayType) or annotation.layout == Layout.SOA:
            return None
        alone = annotation.dtype is None or id(annotation.dtype) in primitive_types.type_ids
        return _array_setter(0 if alone else annotation.dtype.ndim)

    def setters_of(kernel):
        """[(number, setter)] of its arguments that are no templates; None if it has others, or a result."""
        found = [(n, setter_of(one.annotation)) for n, one in enumerate(kernel.arguments)
                 if not isinstance(one.annotation, template)]
        unknown = kernel.return_type is not None or kernel.has_print or len(found) > MOST
        return None if unknown or any(setter is None for _, setter in found) else found

    def launch_kernel(self, compiled, *args):
        if "setters" not in self.__dict__:
            self.setters = setters_of(self)
        record = compiled.make_launch_context()
        if self.setters is None or len(args) != len(self.arguments) or not _set_all(record, self.setters, args):
            return own(self, compiled, *args)
        program = get_runtime().prog
        try:
            program.launch_kernel(program.compile_kernel(program.config(), program.get_device_caps(), compiled), record)
        except Exception as error:
            raise in_words(error) from None
        return None

    launch_kernel.own = own
    kernel_impl.Kernel.launch_kernel = launch_kernel


def _set_real(record, slot, value):
    if not isinstance(value, REALS):
        return False
    record.set_arg_float(slot, float(value))
    return True


def _set_integer(record, slot, value):
    if not isinstance(value, INTEGERS):
        return False
    record.set_arg_int(slot, int(value))
    return True


def _array_setter(inner):
    """Setter of arrays whose last `inner` dimensions are those of an element."""
    def put(record, slot, value):
        if type(value) is not np.ndarray or not value.flags.c_contiguous:
            return False
        shape = value.shape[:-inner] if inner else value.shape
        record.set_arg_external_array_with_shape(slot, value.__array_interface__["data"][0], value.nbytes, shape, 0)
        return True

    return put


def _set_all(record, setters, args):
    """Set the arguments in a record; returns whether it is complete."""
    return all(setter(record, (slot,), args[n]) for slot, (n, setter) in enumerate(setters))
