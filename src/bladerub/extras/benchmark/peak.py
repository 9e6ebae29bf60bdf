"""The arithmetic that this processor can do at best, in the vectors of the time loop."""

from numba import njit

from bladerub.numerics.vectors import LANES, broadcast, lane_sum

CHAINS = 12
"""Products and sums in progress at once: more than a processor needs to be busy, fewer than its registers."""
FLOPS_PER_TURN = CHAINS * LANES * 2


@njit
def turns(n):
    """Multiply and add `n` times in each chain; different starts, so that no chain is left out."""
    factor, addend = broadcast(0.999), broadcast(0.001)
    a, b, c, d = broadcast(1.0), broadcast(1.1), broadcast(1.2), broadcast(1.3)
    e, f, g, h = broadcast(1.4), broadcast(1.5), broadcast(1.6), broadcast(1.7)
    i, j, k, m = broadcast(1.8), broadcast(1.9), broadcast(2.0), broadcast(2.1)
    for _ in range(n):
        a, b, c, d = a * factor + addend, b * factor + addend, c * factor + addend, d * factor + addend
        e, f, g, h = e * factor + addend, f * factor + addend, g * factor + addend, h * factor + addend
        i, j, k, m = i * factor + addend, j * factor + addend, k * factor + addend, m * factor + addend
    return lane_sum(((a + b) + (c + d)) + ((e + f) + (g + h)) + ((i + j) + (k + m)))
