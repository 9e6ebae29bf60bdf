"""Vectors and numbers in the memory of arrays, read and written by address in compiled code.

Compiled code that takes, slices or passes on arrays counts their references each time, which costs more than
what it does with them. It therefore gets records of their `addresses`.
"""

from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from bladerub.numerics.lanes import COORDINATES, LANES
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.vectors import DOUBLE, FUSED, VECTOR, broadcast, instruction, spread, vector


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

    The arrays must stay alive as long as their addresses are in use.
    """
    return type(record)(*(part.ctypes.data if isinstance(part, np.ndarray) else part for part in record))


def _place(builder, address, index, kind):
    start = builder.inttoptr(address, DOUBLE.as_pointer())
    return builder.bitcast(builder.gep(start, [index]), kind.as_pointer())


def place_at(builder, address, number, kind):
    """Build the place of the number `number` of the array at `address`, of this kind."""
    return _place(builder, address, ir.Constant(address.type, number), kind)


@inlined
def address_of(address, index):
    """Address of the number `index` of the array at `address`."""
    return address + 8 * index


@instruction(vector, types.intp, types.intp)
def load(builder, address, index):
    """Load a vector of numbers of the array at `address`, from flat position `index` on."""
    return builder.load(_place(builder, address, index, VECTOR), align=8)


@instruction(types.void, types.intp, types.intp, vector)
def store(builder, address, index, a):
    """Put a vector into the array at `address`, from flat position `index` on."""
    builder.store(a, _place(builder, address, index, VECTOR), align=8)


@instruction(types.float64, types.intp, types.intp)
def read(builder, address, index):
    """Read one number of the array at `address`."""
    return builder.load(_place(builder, address, index, DOUBLE))


@instruction(types.void, types.intp, types.intp, types.float64)
def write(builder, address, index, number):
    """Write one number into the array at `address`."""
    builder.store(number, _place(builder, address, index, DOUBLE))


@inlined
def add_to(address, index, a):
    """Add a vector to the numbers of the array at `address`, from flat position `index` on."""
    store(address, index, load(address, index) + a)


@inlined
def add_to_number(address, index, number):
    """Add to one number of the array at `address`."""
    write(address, index, read(address, index) + number)


@inlined
def copy(source, target, n):
    """Copy `n` numbers, whole vectors."""
    for k in range(0, n, LANES):
        store(target, k, load(source, k))


@inlined
def clear(target, n):
    """Set `n` numbers, whole vectors, to zero."""
    for k in range(0, n, LANES):
        store(target, k, broadcast(0.0))


@intrinsic
def load_fields(context, record, address):
    """Load a vector for each field of the named tuple `record` from consecutive rows of a vector each."""
    return _fields(record, vector, VECTOR)


@intrinsic
def read_fields(context, record, address):
    """Read a number for each field of the named tuple `record`, a vector apart: those of one lane."""
    return _fields(record, types.float64, DOUBLE)


def _fields(record, kind, llvm_type):
    n = len(record.instance_class._fields)
    result = types.NamedUniTuple(kind, n, record.instance_class)

    def generate(context, builder, signature, arguments):
        return context.make_tuple(builder, result, _rows(builder, arguments[1], n, llvm_type))

    return result(record, types.intp), generate


def _rows(builder, address, n, kind=VECTOR):
    """Load `n` vectors, or numbers, that begin a vector apart."""
    return [builder.load(place_at(builder, address, LANES * row, kind), align=8) for row in range(n)]


@intrinsic
def store_fields(context, record, address):
    """Store the vectors of a named tuple into consecutive rows of a vector each."""

    def generate(context, builder, signature, arguments):
        for row, part in enumerate(cgutils.unpack_tuple(builder, arguments[0])):
            builder.store(part, place_at(builder, arguments[1], LANES * row, VECTOR), align=8)
        return context.get_dummy_value()

    return types.void(record, types.intp), generate


@intrinsic
def add_products(context, sums, rows, a):
    """Add to each vector of a tuple the product of `a` and that in its row of the array at `rows`."""

    def generate(context, builder, signature, arguments):
        values, address, factor = arguments
        products = [builder.fmul(row, factor, flags=FUSED) for row in _rows(builder, address, sums.count)]
        pairs = zip(cgutils.unpack_tuple(builder, values), products, strict=True)
        return context.make_tuple(builder, sums, [builder.fadd(*pair, flags=FUSED) for pair in pairs])

    return sums(sums, types.intp, vector), generate


WIDTH = COORDINATES * LANES  # coordinates of the tip; what is below has a vector for each, in registers
_several = types.UniTuple(vector, WIDTH)


@instruction(_several)
def no_sums(builder):
    """`WIDTH` vectors of zeros."""
    return cgutils.pack_array(builder, [ir.Constant(VECTOR, [0.0] * LANES)] * WIDTH)


@instruction(_several, types.intp)
def broadcast_each(builder, address):
    """Read `WIDTH` numbers and put each in every lane of a vector."""
    numbers = (builder.load(place_at(builder, address, i, DOUBLE)) for i in range(WIDTH))
    return cgutils.pack_array(builder, [spread(builder, number) for number in numbers])


@instruction(vector, types.intp, _several)
def sum_of_products(builder, rows, factors):
    """Sum up the products of `WIDTH` rows of an array and as many vectors."""
    products = list(zip(_rows(builder, rows, WIDTH), cgutils.unpack_tuple(builder, factors), strict=True))
    total = _in_halves(builder, products[: 2 * LANES])
    if further := products[2 * LANES :]:
        total = builder.fadd(total, _in_halves(builder, further), flags=FUSED)
    return total


def _in_halves(builder, products):
    """Sum up products in two halves at the same time."""
    halves = [builder.fmul(*product, flags=FUSED) for product in products[:2]]
    for i, product in enumerate(products[2:]):
        halves[i % 2] = builder.fadd(halves[i % 2], builder.fmul(*product, flags=FUSED), flags=FUSED)
    return builder.fadd(*halves, flags=FUSED)
