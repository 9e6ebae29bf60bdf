"""Eight doubles as one value in compiled code: a lane for each interface node, or for each of eight modes.

LLVM maps such a vector to what the processor has: one register of 512 bits, two of 256 or four of 128. Numba
alone leaves the choice to LLVM's loop vectoriser, which does not keep sixteen sums in registers. Inside
compiled functions vectors take part in arithmetic and comparison with each other and with floats.

`maximum`, `minimum`, `where`, `absolute` and `sqrt` are those of NumPy when Python calls them. A formula
written with them, marked by `elementwise`, so serves arrays, and in compiled code arrays, floats and vectors.
"""

import operator
from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.extending import intrinsic, models, overload, register_jitable, register_model

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


def _call(builder, name, result, flags, *arguments):
    kind = ir.FunctionType(result, [argument.type for argument in arguments])
    function = cgutils.get_or_insert_function(builder.module, kind, name)
    return builder.call(function, arguments, fastmath=flags)


def elementwise(function):
    """Mark a formula that compiled code inlines and that Python calls with arrays."""
    return register_jitable(forceinline=True)(function)


def _unary(function, numpy_function, name):
    """Let compiled code compute `function` of arrays by NumPy, of floats and vectors by an LLVM intrinsic."""

    @intrinsic
    def instruction(context, a):
        def generate(context, builder, signature, arguments):
            (kind,) = signature.args
            suffix, result = ("v8f64", _VECTOR) if kind == vector else ("f64", _DOUBLE)
            return _call(builder, f"{name}.{suffix}", result, FUSED, *arguments)

        return a(a), generate

    @overload(function, inline="always")
    def overloaded(a):
        if isinstance(a, types.Array):
            return lambda a: numpy_function(a)
        return lambda a: instruction(a)


def absolute(a):
    """Absolute value."""
    return np.absolute(a)


def sqrt(a):
    """Square root."""
    return np.sqrt(a)


_unary(absolute, np.absolute, "llvm.fabs")
_unary(sqrt, np.sqrt, "llvm.sqrt")


def _extreme(function, numpy_function, comparison):
    """Do the same for an extreme of two, by one instruction, which LLVM's own is not for its NaN."""

    @intrinsic
    def instruction(context, a, b):
        def generate(context, builder, signature, arguments):
            if vector in signature.args:
                arguments = _operands(builder, signature, arguments)
            a, b = arguments
            return builder.select(builder.fcmp_ordered(comparison, a, b), a, b)

        a, b = _typed(a, b)
        return (vector if vector in (a, b) else types.float64)(a, b), generate

    @overload(function, inline="always")
    def overloaded(a, b):
        if isinstance(a, types.Array) or isinstance(b, types.Array):
            return lambda a, b: numpy_function(a, b)
        return lambda a, b: instruction(a, b)


def minimum(a, b):
    """Lower of two; in compiled code the second where one is not a number."""
    return np.minimum(a, b)


def maximum(a, b):
    """Higher of two; in compiled code the second where one is not a number."""
    return np.maximum(a, b)


_extreme(minimum, np.minimum, "<")
_extreme(maximum, np.maximum, ">")


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


smallest_lane = _extreme_lane("<", "Lowest of all lanes, none of which may be not a number.")
largest_lane = _extreme_lane(">", "Highest of all lanes, none of which may be not a number.")


@intrinsic
def broadcast(context, number):
    """Put the same number in every lane."""

    def generate(context, builder, signature, arguments):
        return _spread(builder, *arguments)

    return vector(types.float64), generate


@intrinsic
def lane_sum(context, a):
    """Sum of all lanes."""

    def generate(context, builder, signature, arguments):
        zero = ir.Constant(_DOUBLE, 0.0)
        return _call(builder, "llvm.vector.reduce.fadd.v8f64", _DOUBLE, ANY_ORDER, zero, *arguments)

    return types.float64(a), generate


@intrinsic
def _select(context, condition, a, b):
    def generate(context, builder, signature, arguments):
        kinds, (chosen, *values) = signature.args[1:], arguments
        if condition == mask:
            values = [
                value if kind == vector else _spread(builder, value)
                for kind, value in zip(kinds, values, strict=True)
            ]
        return builder.select(chosen, *values)

    return (vector if condition == mask else types.float64)(condition, *_typed(a, b)), generate


def where(condition, a, b):
    """Take `a` where the condition holds and `b` elsewhere."""
    return np.where(condition, a, b)


@overload(where, inline="always")
def _where(condition, a, b):
    if isinstance(condition, types.Array):
        return lambda condition, a, b: np.where(condition, a, b)
    return lambda condition, a, b: _select(condition, a, b)


@intrinsic
def all_lanes(context, condition):
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
def address_of(address, index):
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


@njit(inline="always")
def add_to(address, index, a):
    """Add a vector to the eight numbers of the array at `address`, from flat position `index` on."""
    store(address, index, load(address, index) + a)


@njit(inline="always")
def add_to_number(address, index, number):
    """Add to one number of the array at `address`."""
    write(address, index, read(address, index) + number)


@njit(inline="always")
def copy(source, target, n):
    """Copy `n` numbers, a multiple of 8."""
    for k in range(0, n, LANES):
        store(target, k, load(source, k))


@njit(inline="always")
def clear(target, n):
    """Set `n` numbers, a multiple of 8, to zero."""
    for k in range(0, n, LANES):
        store(target, k, broadcast(0.0))


@intrinsic
def load_fields(context, record, address):
    """Load a vector for each field of the named tuple `record` from consecutive rows of eight numbers."""
    return _fields(record, vector, _VECTOR, LANES)


@intrinsic
def read_fields(context, record, address):
    """Read a number for each field of the named tuple `record`, eight numbers apart: those of one lane."""
    return _fields(record, types.float64, _DOUBLE, LANES)


def _fields(record, kind, llvm_type, stride):
    names = record.instance_class._fields
    result = types.NamedUniTuple(kind, len(names), record.instance_class)

    def generate(context, builder, signature, arguments):
        address = arguments[1]
        places = (
            _place(builder, address, ir.Constant(address.type, stride * row), llvm_type)
            for row in range(len(names))
        )
        return context.make_tuple(builder, result, [builder.load(place, align=8) for place in places])

    return result(record, types.intp), generate


_SIXTEEN = types.UniTuple(vector, 16)


@intrinsic
def no_sums(context):
    """Sixteen vectors of zeros, for `add_products`."""

    def generate(context, builder, signature, arguments):
        zero = ir.Constant(_VECTOR, [0.0] * LANES)
        return context.make_tuple(builder, _SIXTEEN, [zero] * 16)

    return _SIXTEEN(), generate


@intrinsic
def add_products(context, sums, rows, a):
    """Add to each of sixteen sums the product of `a` and the vector in its row of the array at `rows`."""

    def generate(context, builder, signature, arguments):
        sums, rows, a = arguments
        products = (builder.fmul(row, a, flags=FUSED) for row in _rows(builder, rows))
        more = [
            builder.fadd(so_far, product, flags=FUSED)
            for so_far, product in zip(cgutils.unpack_tuple(builder, sums), products, strict=True)
        ]
        return context.make_tuple(builder, _SIXTEEN, more)

    return _SIXTEEN(_SIXTEEN, types.intp, vector), generate


@intrinsic
def broadcast_each(context, address):
    """Read sixteen numbers and put each in every lane of a vector."""

    def generate(context, builder, signature, arguments):
        (address,) = arguments
        numbers = (
            builder.load(_place(builder, address, ir.Constant(address.type, i), _DOUBLE)) for i in range(16)
        )
        return context.make_tuple(builder, _SIXTEEN, [_spread(builder, number) for number in numbers])

    return _SIXTEEN(types.intp), generate


@intrinsic
def sum_of_products(context, rows, factors):
    """Sum up the products of sixteen rows of vectors and sixteen vectors, in two halves at the same time."""

    def generate(context, builder, signature, arguments):
        rows, factors = arguments
        products = [
            (row, factor)
            for row, factor in zip(_rows(builder, rows), cgutils.unpack_tuple(builder, factors), strict=True)
        ]
        halves = [builder.fmul(*product, flags=FUSED) for product in products[:2]]
        for i, product in enumerate(products[2:]):
            halves[i % 2] = builder.fadd(halves[i % 2], builder.fmul(*product, flags=FUSED), flags=FUSED)
        return builder.fadd(*halves, flags=FUSED)

    return vector(types.intp, _SIXTEEN), generate


def _rows(builder, address):
    """Load sixteen consecutive vectors."""
    places = (_place(builder, address, ir.Constant(address.type, LANES * i), _VECTOR) for i in range(16))
    return [builder.load(place, align=8) for place in places]


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
def lane_sums(a, b, c, d, e, f, g, h):
    """Vector of the sums of all lanes of eight vectors."""
    first, second = _fours(_pairs(a, b), _pairs(c, d)), _fours(_pairs(e, f), _pairs(g, h))
    return _left_4(first, second) + _right_4(first, second)
