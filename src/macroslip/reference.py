"""Bundles of numbers that compiled functions hand on by address.

Numba hands a tuple on number by number. A roller with its laws has some three hundred of them, and every function that
was given it spent most of its compilation on packing and unpacking; a kernel therefore takes the address of its bundles
once, and the functions it calls read from there what they need.
"""

from __future__ import annotations

import functools
import hashlib
from typing import Any

from llvmlite import ir
from numba import TypingError, types
from numba.extending import (
    infer_getattr,
    intrinsic,
    lower_getattr_generic,
    models,
    overload_attribute,
    register_jitable,
    register_model,
)

try:
    # The base class that `infer_getattr` needs; numba.extending has the decorator, but not this.
    from numba.core.typing.templates import AttributeTemplate
except ImportError:
    AttributeTemplate = None


class Reference(types.Type):
    """Type of the address of a named tuple, whose fields are read as those of the tuple itself.

    Attributes
    ----------
    target : numba.types.Type
        Type of the tuple.
    """

    def __init__(self, target: Any) -> None:
        self.target = target
        # The name becomes part of every symbol; that of a tuple names all fields in it.
        digest = hashlib.sha256(str(target).encode()).hexdigest()[:16]
        super().__init__(f"Reference({target.instance_class.__name__}, {digest})")
        if AttributeTemplate is None:
            for name in target.fields:
                _make_readable(name)

    @property
    def instance_class(self) -> type:
        """Class of the tuple, as a type of a tuple has it."""
        return self.target.instance_class

    @property
    def key(self) -> Any:
        """Two references are of the same type if their tuples are."""
        return self.target


def tuple_type(kind: Any) -> Any:
    """Type of the named tuple that a type is, or is the address of."""
    return kind.target if isinstance(kind, Reference) else kind


def _is_bundle(kind: Any) -> bool:
    return isinstance(kind, types.BaseTuple) and hasattr(kind, "instance_class")


@register_model(Reference)
class _ReferenceModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Reference) -> None:
        super().__init__(manager, kind, manager[kind.target].get_value_type().as_pointer())


def _field_type(reference: Reference, name: str) -> Any:
    fields = reference.target.fields
    if name not in fields:
        return None
    kind = reference.target.types[fields.index(name)]
    return Reference(kind) if _is_bundle(kind) else kind


def _read(context: Any, builder: Any, kind: Reference, address: Any, name: str) -> Any:
    index = kind.target.fields.index(name)
    zero, place = ir.Constant(ir.IntType(32), 0), ir.Constant(ir.IntType(32), index)
    field = builder.gep(address, [zero, place], inbounds=True)
    found = kind.target.types[index]
    return field if _is_bundle(found) else _uncounted(context, builder, found, builder.load(field))


@functools.cache
def _make_readable(name: str) -> None:
    """Let kernels read a field of this name by what numba calls its high-level interface: each is compiled by itself."""

    def field(typingctx: Any, reference: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return _read(context, builder, reference, arguments[0], name)

        return _field_type(reference, name)(reference), generate

    read: Any = intrinsic(field)

    @overload_attribute(Reference, name)
    def _reading(reference):
        return (lambda reference: read(reference)) if _field_type(reference, name) else None


if AttributeTemplate is not None:

    @infer_getattr
    class _ReferenceAttribute(AttributeTemplate):
        key = Reference

        def generic_resolve(self, reference: Reference, name: str) -> Any:
            return _field_type(reference, name)

    lower_getattr_generic(Reference)(_read)


def _uncounted(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    """The value with arrays that are not counted.

    Numba counts how often an array is referred to, with an atomic operation for each array that is read from a tuple.
    The caller of a kernel keeps its arguments, so that nothing in it needs to be counted.
    """
    if isinstance(kind, types.Array):
        struct = context.make_array(kind)(context, builder, value)
        struct.meminfo = struct.meminfo.type(None)
        struct.parent = struct.parent.type(None)
        return struct._getvalue()
    if isinstance(kind, types.BaseTuple):
        parts = [_uncounted(context, builder, one, builder.extract_value(value, k)) for k, one in enumerate(kind.types)]
        return context.make_tuple(builder, kind, parts)
    return value


def _by_reference(typingctx: Any, value: Any) -> Any:
    """The address of a named tuple, for use inside a kernel that was given it as an argument.

    Parameters
    ----------
    value : named tuple, or array
        An argument of the kernel. An array is returned itself, but not counted. What is returned must not outlive the
        call.
    """

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        if not _is_bundle(value):
            return _uncounted(context, builder, value, arguments[0])
        return _placed(builder, arguments[0])

    return (Reference(value) if _is_bundle(value) else value)(value), generate


def _loaded(typingctx: Any, reference: Any) -> Any:
    """The named tuple that a reference points to."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _uncounted(context, builder, reference.target, builder.load(arguments[0]))

    return reference.target(reference), generate


def _placed(builder: Any, value: Any) -> Any:
    """Address of a value, in memory of the function's own."""
    with builder.goto_entry_block():
        address = builder.alloca(value.type)
    builder.store(value, address)
    return address


def _write(typingctx: Any, reference: Any, value: Any) -> Any:
    """Write a named tuple to where a reference to such a one points."""
    if not isinstance(reference, Reference) or reference.target != value:
        raise TypingError(f"{value} cannot be written to {reference}")

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        builder.store(arguments[1], arguments[0])
        return context.get_dummy_value()

    return types.none(reference, value), generate


def _packed(typingctx: Any, value: Any, buffer: Any) -> Any:
    """Write a named tuple to an array of bytes if it is long enough; how many bytes the tuple takes.

    Arrays in the tuple are not counted: they must be kept by whoever keeps the bytes.
    """

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        size = ir.Constant(ir.IntType(64), context.get_abi_sizeof(arguments[0].type))
        array = context.make_array(buffer)(context, builder, arguments[1])
        with builder.if_then(builder.icmp_signed(">=", array.nitems, size)):
            builder.store(arguments[0], builder.bitcast(array.data, arguments[0].type.as_pointer()))
        return size

    return types.int64(value, buffer), generate


def calling(given: Any, result: Any) -> Any:
    """A function for kernels that calls another compiled function by its address.

    What is called is compiled by itself, once: nothing of it becomes part of the kernel, which is the same whatever it
    calls. It is a `numba.cfunc` that returns nothing and has three arguments: `Reference` to the data that it belongs to,
    to what it is given, and to the result, which it writes.

    Parameters
    ----------
    given, result : numba.types.Type
        Named tuples. A result that is the type of a reference is not written anew: the kernel hands it on.

    Returns
    -------
    intrinsic
        Called as call(address, data, given) or call(address, data, given, result): addresses of function and data, and
        named tuples.
    """

    def call(builder: Any, values: Any, place: Any) -> None:
        pointer = ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [pointer, pointer, pointer])
        function, data = builder.inttoptr(values[0], kind.as_pointer()), builder.inttoptr(values[1], pointer)
        source = _placed(builder, values[2])
        builder.call(function, [data, builder.bitcast(source, pointer), builder.bitcast(place, pointer)])

    def check(found: Any, expected: Any) -> None:
        if found != expected:
            raise TypingError(f"{found} is not the {expected} that is expected")

    def returning(typingctx: Any, address: Any, data: Any, arguments: Any) -> Any:
        check(arguments, given)

        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            with builder.goto_entry_block():
                place = builder.alloca(context.get_value_type(result))
            call(builder, values, place)
            return builder.load(place)

        return result(address, data, arguments), generate

    def handing_on(typingctx: Any, address: Any, data: Any, arguments: Any, target: Any) -> Any:
        check(arguments, given)
        check(target, result)

        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            call(builder, values, values[3])
            return context.get_dummy_value()

        return types.none(address, data, arguments, target), generate

    return intrinsic(handing_on if isinstance(result, Reference) else returning)


by_reference: Any = intrinsic(_by_reference)
loaded: Any = intrinsic(_loaded)
write: Any = intrinsic(_write)
packed: Any = intrinsic(_packed)


def taking(law: Any, function: Any) -> Any:
    """A function of a law, for kernels that are compiled for the law's type `law`.

    A law of the user's own is handed on itself, in case its functions use more than its fields.
    """
    if not isinstance(law, Reference) or law.instance_class.__module__.startswith("macroslip."):
        return function

    @register_jitable
    def of_tuple(law: Any, *rest: Any) -> Any:
        return function(loaded(law), *rest)

    return of_tuple
