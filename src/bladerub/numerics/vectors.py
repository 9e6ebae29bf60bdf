"""Eight doubles, or more, as one value in compiled code: a lane for each interface node or mode.

LLVM maps such a vector to what the processor has: one register of 512 bits, two of 256 or four of 128. Numba
alone leaves the choice to LLVM's loop vectoriser, which does not keep sixteen sums in registers. Inside
compiled functions vectors take part in arithmetic and comparison with each other and with floats.

`maximum`, `minimum`, `where`, `absolute` and `sqrt` are those of NumPy when Python calls them. A formula
written with them, marked by `elementwise`, so serves arrays, and in compiled code arrays, floats and vectors.
"""

import functools
import operator
from itertools import product

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, lower_builtin, models, overload, register_model, type_callable

from bladerub.numerics.lanes import LANES
from bladerub.numerics.machine_code import INLINED, inlined

FUSED = ("contract", "nsz")  # a product and a sum may be one instruction; nothing is reordered
ANY_ORDER = (*FUSED, "reassoc")

DOUBLE, _INDEX = ir.DoubleType(), ir.IntType(32)
VECTOR, _MASK = ir.VectorType(DOUBLE, LANES), ir.VectorType(ir.IntType(1), LANES)
_UNDEFINED = ir.Constant(VECTOR, ir.Undefined)
_HALVES = [LANES >> n for n in range(1, LANES.bit_length())]  # 4, 2, 1


class _Lanes(types.Type):
    """Numba's name of a vector type."""


vector, mask = _Lanes(f"float64x{LANES}"), _Lanes(f"boolx{LANES}")
_EITHER = (vector, types.float64)


class _Primitive(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, VECTOR if kind == vector else _MASK)


register_model(_Lanes)(_Primitive)


def instruction(result, *kinds):
    """Decorate what builds the LLVM code of a function of arguments of these `kinds`.

    It takes the builder and the LLVM values of the arguments. Compiled code calls it without the builder.
    """

    def decorate(build):
        @functools.wraps(build)  # its signature, too: the builder is in the place of Numba's context
        def typed(*_):
            def generate(context, builder, signature, arguments):
                value = build(builder, *arguments)
                return context.get_dummy_value() if result == types.void else value

            return result(*kinds), generate

        return intrinsic(typed)

    return decorate


def _lanes(numbers):
    return ir.Constant(ir.VectorType(_INDEX, LANES), list(numbers))


def spread(builder, scalar):
    """Build a vector with `scalar` in every lane."""
    first = builder.insert_element(_UNDEFINED, scalar, ir.Constant(_INDEX, 0))
    return builder.shuffle_vector(first, _UNDEFINED, _lanes([0] * LANES))


def _operands(builder, kinds, values):
    return [
        value if kind == vector else spread(builder, value) for kind, value in zip(kinds, values, strict=True)
    ]


def _typed(*kinds):
    """Vectors as they are and any number as a float."""
    return [kind if kind == vector else types.float64 for kind in kinds]


def _built_in(function, typed, *cases):
    """Decorate what builds the LLVM code of `function`, for arguments of the kinds of each case.

    `typed` gives the signature, or None for other arguments. A function to be inlined would take the compiler
    longer, for every kind of its arguments.
    """

    def decorate(generate):
        type_callable(function)(lambda context: typed)
        for kinds in cases:
            lower_builtin(function, *kinds)(generate)

    return decorate


def _binary(python_operator, result, build):
    """Let `python_operator` work on vectors, a vector and a number, or the vectors of two named tuples."""

    def typed(a, b):
        return result(*_typed(a, b)) if vector in (a, b) else None

    @_built_in(python_operator, typed, (vector, vector), (vector, types.float64), (types.float64, vector))
    def _(context, builder, signature, arguments):
        return build(builder, *_operands(builder, signature.args, arguments))

    def typed_tuples(a, b):
        return a(a, b) if isinstance(a, types.NamedUniTuple) and a == b and a.dtype == result else None

    @_built_in(python_operator, typed_tuples, (types.NamedUniTuple, types.NamedUniTuple))
    def _(context, builder, signature, arguments):
        pairs = zip(*(cgutils.unpack_tuple(builder, argument) for argument in arguments), strict=True)
        return context.make_tuple(builder, signature.return_type, [build(builder, *pair) for pair in pairs])


_binary(operator.add, vector, lambda builder, a, b: builder.fadd(a, b, flags=FUSED))
_binary(operator.sub, vector, lambda builder, a, b: builder.fsub(a, b, flags=FUSED))
_binary(operator.mul, vector, lambda builder, a, b: builder.fmul(a, b, flags=FUSED))
_binary(operator.truediv, vector, lambda builder, a, b: builder.fdiv(a, b, flags=FUSED))
_binary(operator.gt, mask, lambda builder, a, b: builder.fcmp_ordered(">", a, b))
_binary(operator.le, mask, lambda builder, a, b: builder.fcmp_ordered("<=", a, b))


@_built_in(operator.and_, lambda a, b: mask if a == b == mask else None, (mask, mask))
def _(context, builder, signature, arguments):
    return builder.and_(*arguments)


def _call(builder, name, result, flags, *arguments):
    kind = ir.FunctionType(result, [argument.type for argument in arguments])
    function = cgutils.get_or_insert_function(builder.module, kind, name)
    return builder.call(function, arguments, fastmath=flags)


elementwise = inlined  # a formula of arrays, floats or vectors


def _of_arrays(function):
    """Let compiled code compute `function` of arrays as Python does."""

    @overload(function, jit_options=INLINED, strict=False)
    def choose(*arguments):
        return function if any(isinstance(argument, types.Array) for argument in arguments) else None


def _unary(function, name):
    """Let compiled code compute `function` of floats and vectors by an LLVM intrinsic."""
    _of_arrays(function)

    def typed(a):
        return a if a in (vector, types.float64) else None

    @_built_in(function, typed, (vector,), (types.float64,))
    def _(context, builder, signature, arguments):
        suffix, result = (f"v{LANES}f64", VECTOR) if signature.args[0] == vector else ("f64", DOUBLE)
        return _call(builder, f"{name}.{suffix}", result, FUSED, *arguments)


def absolute(a):
    """Absolute value."""
    return np.absolute(a)


def sqrt(a):
    """Square root."""
    return np.sqrt(a)


_unary(absolute, "llvm.fabs")
_unary(sqrt, "llvm.sqrt")


def _extreme(function, comparison):
    """Do the same for an extreme of two, by one instruction, which LLVM's own is not for its NaN."""
    _of_arrays(function)

    def typed(a, b):
        if isinstance(a, types.Array) or isinstance(b, types.Array):
            return None
        return (vector if vector in (a, b) else types.float64)(*_typed(a, b))

    @_built_in(function, typed, *product(_EITHER, repeat=2))
    def _(context, builder, signature, arguments):
        if vector in signature.args:
            arguments = _operands(builder, signature.args, arguments)
        a, b = arguments
        return builder.select(builder.fcmp_ordered(comparison, a, b), a, b)


def minimum(a, b):
    """Lower of two; in compiled code the second where one is not a number."""
    return np.minimum(a, b)


def maximum(a, b):
    """Higher of two; in compiled code the second where one is not a number."""
    return np.maximum(a, b)


_extreme(minimum, "<")
_extreme(maximum, ">")


def _extreme_lane(builder, comparison, extremes):
    for width in _HALVES:  # against each other
        order = _lanes((i + width) % LANES for i in range(LANES))
        other = builder.shuffle_vector(extremes, _UNDEFINED, order)
        extremes = builder.select(builder.fcmp_ordered(comparison, extremes, other), extremes, other)
    return builder.extract_element(extremes, ir.Constant(_INDEX, 0))


@instruction(types.float64, vector)
def smallest_lane(builder, a):
    """Lowest of all lanes, none of which may be not a number."""
    return _extreme_lane(builder, "<", a)


@instruction(types.float64, vector)
def largest_lane(builder, a):
    """Highest of all lanes, none of which may be not a number."""
    return _extreme_lane(builder, ">", a)


@instruction(vector, types.float64)
def broadcast(builder, number):
    """Put the same number in every lane."""
    return spread(builder, number)


@instruction(types.float64, vector)
def lane_sum(builder, a):
    """Sum of all lanes."""
    zero = ir.Constant(DOUBLE, 0.0)
    return _call(builder, f"llvm.vector.reduce.fadd.v{LANES}f64", DOUBLE, ANY_ORDER, zero, a)


def where(condition, a, b):
    """Take `a` where the condition holds and `b` elsewhere."""
    return np.where(condition, a, b)


def _chosen(condition, a, b):
    if isinstance(condition, types.Array):
        return None
    return (vector if condition == mask else types.float64)(condition, *_typed(a, b))


_of_arrays(where)


@_built_in(where, _chosen, (types.boolean, types.float64, types.float64), *product([mask], _EITHER, _EITHER))
def _(context, builder, signature, arguments):
    condition, *values = arguments
    if signature.args[0] == mask:
        values = _operands(builder, signature.args[1:], values)
    return builder.select(condition, *values)


@instruction(types.boolean, mask)
def all_lanes(builder, condition):
    """Whether the condition holds in all lanes."""
    bits = builder.bitcast(condition, ir.IntType(LANES))
    return builder.icmp_unsigned("==", bits, ir.Constant(bits.type, 2**LANES - 1))


def _paired(builder, width, a, b):
    """Build the sums of neighbouring parts of `a`, and of `b`, each `width` lanes wide, in turns."""
    starts = range(0, LANES, 2 * width)
    first_lanes = [
        lane
        for start in starts
        for offset in (start, LANES + start)
        for lane in range(offset, offset + width)
    ]
    second_lanes = [lane + width for lane in first_lanes]
    first_half = builder.shuffle_vector(a, b, _lanes(first_lanes))
    return builder.fadd(first_half, builder.shuffle_vector(a, b, _lanes(second_lanes)), flags=FUSED)


@intrinsic
def lane_sums(context, record, vectors):
    """Sum up the lanes of each of many vectors: the first N sums are the first vector of a named tuple.

    N is the number of lanes, `record` the type of the tuple, which has a vector for each N of the `vectors`.
    """
    result = types.NamedUniTuple(vector, vectors.count // LANES, record.instance_class)

    def generate(context, builder, signature, arguments):
        sums = cgutils.unpack_tuple(builder, arguments[1])
        for width in reversed(_HALVES):
            sums = [_paired(builder, width, a, b) for a, b in zip(sums[::2], sums[1::2], strict=True)]
        return context.make_tuple(builder, result, sums)

    return result(record, vectors), generate
