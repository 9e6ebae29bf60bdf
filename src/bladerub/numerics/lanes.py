"""How many doubles a vector of compiled code has: eight, or as many more as a wide blade tip has nodes.

Every vector of the time loop has a lane for each interface node, and its length is a constant of the compiled
code. So the modules that have it are made once for each length that is asked for
(`bladerub.contact.variants`): the same source, imported again while `LANES` is another.
"""

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager

from bladerub import plugins

USUAL = 8
"""Doubles in a vector of the modules that are imported by name."""
LANES = USUAL
"""Doubles in a vector of the module that is being imported."""
LAW = ""
"""Source of the law that the module being imported is compiled with; empty for that of the paper."""

FEWEST_NODES, MOST_NODES = 4, 32
"""Interface nodes that a blade may have."""


def lanes_for(n_nodes: int) -> int:
    """Doubles in the vectors for a tip with `n_nodes` nodes: a power of two, whose halves can be paired."""
    lanes = USUAL
    while lanes < n_nodes:
        lanes *= 2
    return lanes


def instance_name(lanes: int, law: str) -> str:
    """Name what is compiled for vectors of `lanes` and a law, by the digest of its source."""
    return f"{lanes}-{hashlib.sha256(law.encode()).hexdigest()[:16]}" if law else f"{lanes}"


@contextmanager
def importing_for(lanes: int, law: str) -> Iterator[None]:
    """Let modules that are imported in this context have vectors of `lanes`, and belong to a law."""
    global LANES, LAW
    LANES, LAW = lanes, law
    try:
        yield
    finally:
        LANES, LAW = USUAL, ""


def counterparts() -> list[str]:
    """Name the modules that plug into the loop (`bladerub.contact.kernel.composition`), below `bladerub`."""
    return [f"{place}.kernel" for place in plugins.offered("MOTIONS").values()]
