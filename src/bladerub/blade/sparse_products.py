"""Products of a large sparse symmetric matrix with several vectors at once."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numba import njit
from scipy import sparse

from bladerub.numerics.memory import load, store
from bladerub.numerics.vectors import LANES, broadcast

_THREADS = 2  # each computes rows of its own, so their number changes no bit


class Product:
    """Multiplies by a symmetric matrix (n, n) whose three rows of a node have the same columns.

    A node's three rows are summed together, so that what they are multiplied by is loaded once; SciPy loads
    it for each row and holds the lock of the interpreter. Other matrices are left to SciPy.
    """

    def __init__(self, matrix: sparse.csc_array):
        self._matrix = matrix  # its columns are read as rows
        self._is_by_node = matrix.shape[0] % 3 == 0 and _is_by_node(matrix.indptr, matrix.indices)

    def __call__(self, block: np.ndarray) -> np.ndarray:
        """Multiply by (n,) or (n, k)."""
        if block.ndim == 1 or not self._is_by_node:
            return self._matrix @ block
        n, width = block.shape
        padded = np.zeros((n, -(-width // LANES) * LANES))
        padded[:, :width] = block
        product = np.empty(padded.shape)
        starts = self._matrix.indptr
        even = np.linspace(0, starts[-1], _THREADS + 1)[1:-1]
        shares = [0, *np.searchsorted(starts[::3], even), n // 3]  # of the nodes, with as many entries each

        def multiply(first_node: int, last_node: int) -> None:
            _multiply(
                *(starts, self._matrix.indices, self._matrix.data),
                *(padded.ctypes.data, product.ctypes.data, padded.shape[1]),
                *(3 * first_node, 3 * last_node),
            )

        with ThreadPoolExecutor(_THREADS) as pool:
            list(pool.map(multiply, shares, shares[1:]))  # raises their errors
        return product[:, :width]


@njit(nogil=True)
def _is_by_node(starts, columns):
    """Whether each row of three has the same columns as the first."""
    for row in range(0, starts.size - 1, 3):
        first, count = starts[row], starts[row + 1] - starts[row]
        for other in (row + 1, row + 2):
            if starts[other + 1] - starts[other] != count:
                return False
            for entry in range(count):
                if columns[starts[other] + entry] != columns[first + entry]:
                    return False
    return True


@njit(nogil=True)
def _multiply(starts, columns, values, block, product, width, first_row, last_row):
    """Set the rows of `product` from `first_row`, the first of a node, up to `last_row`."""
    for row in range(first_row, last_row, 3):
        x, y, z = starts[row], starts[row + 1], starts[row + 2]
        for tile in range(0, width, LANES):
            sum_x = sum_y = sum_z = broadcast(0.0)
            for entry in range(y - x):
                factor = load(block, columns[x + entry] * width + tile)
                sum_x = sum_x + values[x + entry] * factor
                sum_y = sum_y + values[y + entry] * factor
                sum_z = sum_z + values[z + entry] * factor
            place = row * width + tile
            store(product, place, sum_x)
            store(product, place + width, sum_y)
            store(product, place + 2 * width, sum_z)
