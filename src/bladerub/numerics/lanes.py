"""How many doubles a vector of compiled code has: eight, or as many more as a wide blade tip has nodes.

Every vector of the time loop has a lane for each interface node, and its length is a constant of the compiled
code. So the modules that have it are made once for each length that is asked for
(`bladerub.contact.laws.module_for`): the same source, imported again while `LANES` is another. The number of
coordinates of each node is such a constant, too.
"""

USUAL = 8  # doubles in a vector of the modules that are imported by name
LANES = USUAL  # doubles in a vector of the module that is being imported
COORDINATES = 2  # of each node in that module: two, and a third where the tip has a further motion
INSTANCE = f"{USUAL}"  # name of what is compiled by it: of these vectors, and of what is not the paper's
FEWEST_NODES, MOST_NODES = 4, 32  # interface nodes that a blade may have


def lanes_for(n_nodes: int) -> int:
    """Doubles in the vectors for a tip with `n_nodes` nodes: a power of two, whose halves can be paired."""
    lanes = USUAL
    while lanes < n_nodes:
        lanes *= 2
    return lanes
