"""The compiled time loop on modes, gaps and elements that a test gives, without a blade."""

import numpy as np

from bladerub.contact import law
from bladerub.contact.kernel import records
from bladerub.contact.kernel.free_flight import free_flight
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.kernel.modal import pack
from bladerub.contact.schemes import normal_compliance

ONES = np.ones(8)


def simulation(rule, contact, gap, hardening=1e12, coulomb=False, steps=1, half_width=2.0, **tip):
    """Set up the loop for the rows of `gap` (N, 8), with `steps` of them in the passage of an element.

    The elements under the tip add up to the stiffness of `contact` (the casing, where it is infinite), and
    harden by so many times their own. Fields of `records.Tip` may be numbers for all nodes.
    """
    own = np.diag(normal_compliance(rule.compliance, 8, contact.radial, contact.tangential))
    rigid = bool(np.isinf(contact.stiffness).all())
    each = ONES if rigid else contact.stiffness / (2 * half_width)
    hard = hardening * each
    stator = records.Stator(
        initial_gap=gap,
        minimum_gap=np.full(len(gap), -np.inf),
        law=np.array(law.Element(each, hard, 0 * each, 1 / each, 1 / (each + hard))),
        n_elements=len(gap),
        is_rigid=rigid,
        normal_factor=contact.radial,
        tangential_factor=contact.tangential,
        self_compliance=np.where(own > 0, own, 1.0),  # of nodes that meet nothing
        coulomb=coulomb,
    )
    of_nodes = {"start": 0.0, "per_metre": 1.0, "radius": 1.0, "lever": 1.0}
    of_nodes = {name: tip.pop(name, value) * ONES for name, value in of_nodes.items()}
    profile = {"half_width": half_width, "curvature": 0.0, "search_range": 0.0, "limit": 1e6}
    here = records.Tip(**of_nodes | profile | tip)
    state = records.at_rest(rule.omega.size, len(gap))
    return Simulation(pack(rule), free_flight(rule, 1, 0.0), stator, here, state, steps)
