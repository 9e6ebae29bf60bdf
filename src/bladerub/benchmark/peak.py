"""The arithmetic that this processor can do at best, in the vectors of the time loop."""

from __future__ import annotations

from numba import njit

from bladerub.contact.kernel.vectors import LANES, splat, total

CHAINS = 12
"""Products and sums under way at once: more than a processor needs to be busy, fewer than its registers."""
FLOPS_PER_TURN = CHAINS * LANES * 2


@njit
def turns(n):
    """Multiply and add `n` times in each chain; different starts, so that no chain is left out."""
    by, more = splat(0.999), splat(0.001)
    a, b, c, d = splat(1.0), splat(1.1), splat(1.2), splat(1.3)
    e, f, g, h = splat(1.4), splat(1.5), splat(1.6), splat(1.7)
    i, j, k, m = splat(1.8), splat(1.9), splat(2.0), splat(2.1)
    for _ in range(n):
        a, b, c, d = a * by + more, b * by + more, c * by + more, d * by + more
        e, f, g, h = e * by + more, f * by + more, g * by + more, h * by + more
        i, j, k, m = i * by + more, j * by + more, k * by + more, m * by + more
    return total(((a + b) + (c + d)) + ((e + f) + (g + h)) + ((i + j) + (k + m)))
