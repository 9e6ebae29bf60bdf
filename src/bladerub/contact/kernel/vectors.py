"""Eight doubles as one value in compiled code: a lane for each interface node, or for each of eight modes.

LLVM maps such a vector to what the processor has: one register of 512 bits, two of 256 or four of 128. Numba
alone leaves the choice to LLVM's loop vectoriser, which does not keep sixteen sums in registers. Inside
compiled functions vectors take part in arithmetic and comparison with each other and with floats.
"""

from __future__ import annotations

import operator
from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.extending import intrinsic, models, overload, register_model

LANES = 8
FUSED = ("contract", "nsz")  # a product and a sum may be one instruction; nothing is reordered
ANY_ORDER = (*FUSED, "reassoc")

_DOUBLE, _INDEX = ir.DoubleType(), ir.IntType(32)
_VECTOR, _MASK = ir.VectorType(_DOUBLE, LANES), ir.VectorType(ir.IntType(1), LANES)
_UNDEFINED = ir.Constant(_VECTOR, ir.Undefined)


class _Lanes(types.Type):
    """Numba's name of a vector type."""


vector, mask = _Lanes("float64x8"), _Lanes("boolx8")


class _Primitive(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, _VECTOR if kind == vector else _MASK)


register_model(_Lanes)(_Primitive)


def _lanes(numbers):
    return ir.Constant(ir.VectorType(_INDEX, LANES), list(numbers))


def _spread(builder, scalar):
    first = builder.insert_element(_UNDEFINED, scalar, ir.Constant(_INDEX, 0))
    return builder.shuffle_vector(first, _UNDEFINED, _lanes([0] * LANES))


def _operands(builder, signature, arguments):
    return [
        value if kind == vector else _spread(builder, value)
        for kind, value in zip(signature.args, arguments, strict=True)
    ]


def _typed(*kinds):
    """Vectors as they are and any number as a float."""
    return [kind if kind == vector else types.float64 for kind in kinds]


def _binary(python_operator, result, build):
    """Let `python_operator` work on vectors, or a vector and a number."""

    @intrinsic
    def instruction(context, a, b):
        def generate(context, builder, signature, arguments):
            return build(builder, *_operands(builder, signature, arguments))

        return result(*_typed(a, b)), generate

    @overload(python_operator, inline="always")
    def overloaded(a, b):
        if vector in (a, b):
            return lambda a, b: instruction(a, b)
        return None


_binary(operator.add, vector, lambda builder, a, b: builder.fadd(a, b, flags=FUSED))
_binary(operator.sub, vector, lambda builder, a, b: builder.fsub(a, b, flags=FUSED))
_binary(operator.mul, vector, lambda builder, a, b: builder.fmul(a, b, flags=FUSED))
_binary(operator.truediv, vector, lambda builder, a, b: builder.fdiv(a, b, flags=FUSED))
_binary(operator.gt, mask, lambda builder, a, b: builder.fcmp_ordered(">", a, b))
_binary(operator.le, mask, lambda builder, a, b: builder.fcmp_ordered("<=", a, b))


@intrinsic
def _both(context, a, b):
    return mask(a, b), lambda context, builder, signature, arguments: builder.and_(*arguments)


@overload(operator.and_, inline="always")
def _and(a, b):
    if a == b == mask:
        return lambda a, b: _both(a, b)
    return None


def _call(builder, name, result, *arguments):
    kind = ir.FunctionType(result, [argument.type for argument in arguments])
    function = cgutils.get_or_insert_function(builder.module, kind, name)
    return builder.call(function, arguments, fastmath=ANY_ORDER if result == _DOUBLE else FUSED)


def _function(name, doc):
    """Make a function of one vector from an LLVM intrinsic of that name."""

    @intrinsic
    def function(context, a):
        def generate(context, builder, signature, arguments):
            return _call(builder, name, _VECTOR, *arguments)

        return vector(a), generate

    function.__doc__ = doc
    return function


magnitude = _function("llvm.fabs.v8f64", "Absolute value.")
root = _function("llvm.sqrt.v8f64", "Square root.")


def _extreme(comparison, doc):
    """Make a function that takes the extreme of two: one instruction, which LLVM's own is not for its NaN."""

    @intrinsic
    def function(context, a, b):
        def generate(context, builder, signature, arguments):
            a, b = _operands(builder, signature, arguments)
            return builder.select(builder.fcmp_ordered(comparison, a, b), a, b)

        return vector(*_typed(a, b)), generate

    function.__doc__ = doc
    return function


lower = _extreme("<", "Lane by lane the lower of two; the second where one is not a number.")
higher = _extreme(">", "Lane by lane the higher of two; the second where one is not a number.")


def _extreme_lane(comparison, doc):
    @intrinsic
    def function(context, a):
        def generate(context, builder, signature, arguments):
            (rest,) = arguments
            for width in (4, 2, 1):  # halves against each other
                other = builder.shuffle_vector(
                    rest, _UNDEFINED, _lanes((i + width) % LANES for i in range(LANES))
                )
                rest = builder.select(builder.fcmp_ordered(comparison, rest, other), rest, other)
            return builder.extract_element(rest, ir.Constant(_INDEX, 0))

        return types.float64(a), generate

    function.__doc__ = doc
    return function


lowest = _extreme_lane("<", "Lowest of all lanes, none of which may be not a number.")
highest = _extreme_lane(">", "Highest of all lanes, none of which may be not a number.")


@intrinsic
def splat(context, number):
    """Put the same number in every lane."""

    def generate(context, builder, signature, arguments):
        return _spread(builder, *arguments)

    return vector(types.float64), generate


@intrinsic
def total(context, a):
    """Sum of all lanes."""

    def generate(context, builder, signature, arguments):
        return _call(builder, "llvm.vector.reduce.fadd.v8f64", _DOUBLE, ir.Constant(_DOUBLE, 0.0), *arguments)

    return types.float64(a), generate


@intrinsic
def choose(context, condition, a, b):
    """Take `a` in the lanes where the condition holds and `b` in the others."""

    def generate(context, builder, signature, arguments):
        yes, no = (
            value if kind == vector else _spread(builder, value)
            for kind, value in zip(signature.args[1:], arguments[1:], strict=True)
        )
        return builder.select(arguments[0], yes, no)

    return vector(mask, *_typed(a, b)), generate


@intrinsic
def everywhere(context, condition):
    """Whether the condition holds in all lanes."""

    def generate(context, builder, signature, arguments):
        bits = builder.bitcast(arguments[0], ir.IntType(LANES))
        return builder.icmp_unsigned("==", bits, ir.Constant(bits.type, 2**LANES - 1))

    return types.boolean(condition), generate


def aligned(record: NamedTuple) -> NamedTuple:
    """Copy each array of a record so that it starts where a vector may: one that straddles lines is slow."""
    return type(record)(*(_aligned(part) if isinstance(part, np.ndarray) else part for part in record))


def _aligned(array):
    buffer = np.empty(array.size + LANES)
    start = -(buffer.ctypes.data // buffer.itemsize) % LANES
    copy = buffer[start : start + array.size].reshape(array.shape)
    copy[...] = array
    return copy


def addresses(record: NamedTuple) -> NamedTuple:
    """Put the address of its first number in the place of each array of a record made by `aligned`.

    Compiled code that takes, slices or passes on arrays counts their references each time, which costs more
    than what it does with them. The arrays must stay alive as long as their addresses are in use.
    """
    return type(record)(*(part.ctypes.data if isinstance(part, np.ndarray) else part for part in record))


def _place(builder, address, index, kind):
    start = builder.inttoptr(address, _DOUBLE.as_pointer())
    return builder.bitcast(builder.gep(start, [index]), kind.as_pointer())


@njit(inline="always")
def at(address, index):
    """Address of the number `index` of the array at `address`."""
    return address + 8 * index


@intrinsic
def load(context, address, index):
    """Load eight numbers of the array at `address`, from flat position `index` on."""

    def generate(context, builder, signature, arguments):
        return builder.load(_place(builder, *arguments, _VECTOR), align=8)

    return vector(types.intp, types.intp), generate


@intrinsic
def store(context, address, index, a):
    """Put a vector into the array at `address`, from flat position `index` on."""

    def generate(context, builder, signature, arguments):
        *where, value = arguments
        builder.store(value, _place(builder, *where, _VECTOR), align=8)
        return context.get_dummy_value()

    return types.void(types.intp, types.intp, vector), generate


@intrinsic
def read(context, address, index):
    """Read one number of the array at `address`."""

    def generate(context, builder, signature, arguments):
        return builder.load(_place(builder, *arguments, _DOUBLE))

    return types.float64(types.intp, types.intp), generate


@intrinsic
def write(context, address, index, number):
    """Write one number into the array at `address`."""

    def generate(context, builder, signature, arguments):
        *where, value = arguments
        builder.store(value, _place(builder, *where, _DOUBLE))
        return context.get_dummy_value()

    return types.void(types.intp, types.intp, types.float64), generate


def _shuffle(lanes):
    @intrinsic
    def shuffled(context, a, b):
        def generate(context, builder, signature, arguments):
            return builder.shuffle_vector(*arguments, _lanes(lanes))

        return vector(a, b), generate

    return shuffled


_left_1, _right_1 = _shuffle([0, 8, 2, 10, 4, 12, 6, 14]), _shuffle([1, 9, 3, 11, 5, 13, 7, 15])
_left_2, _right_2 = _shuffle([0, 1, 8, 9, 4, 5, 12, 13]), _shuffle([2, 3, 10, 11, 6, 7, 14, 15])
_left_4, _right_4 = _shuffle([0, 1, 2, 3, 8, 9, 10, 11]), _shuffle([4, 5, 6, 7, 12, 13, 14, 15])


@njit(inline="always")
def _pairs(a, b):
    return _left_1(a, b) + _right_1(a, b)


@njit(inline="always")
def _fours(a, b):
    return _left_2(a, b) + _right_2(a, b)


@njit(inline="always")
def totals(a, b, c, d, e, f, g, h):
    """Vector of the sums of all lanes of eight vectors."""
    first, second = _fours(_pairs(a, b), _pairs(c, d)), _fours(_pairs(e, f), _pairs(g, h))
    return _left_4(first, second) + _right_4(first, second)
