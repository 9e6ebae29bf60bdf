"""Run drawn simulations whose arrays end, or begin, at a page that may not be touched: a signal ends them.

Arguments: number of runs, seed, most interface nodes, laws by name; or ``provoke``, to touch such a page.
"""

import contextlib
import ctypes
import mmap
import sys
from collections import Counter
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))
import stand_in

from bladerub.contact.kernel import loop
from bladerub.contact.laws import module_for, module_of
from bladerub.contact.run import simulate
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.extras.rows import kernel as row
from bladerub.extras.rows.row import simulate_row
from bladerub.extras.rows.spec import Disk, Row
from bladerub.numerics import lanes, memory

PAGE = mmap.PAGESIZE
PARAMETERS = {"viscoplastic": {"viscosity": 1e4}, "brittle": {"break_strain": 5e-3}, "thermal": LAYER}
_protect = ctypes.CDLL(None, use_errno=True).mprotect
at_end = True


def guarded(array):
    """Copy an array to between two pages without access, to the end of what is there or to its begin."""
    pages = max(1, -(-array.nbytes // PAGE))
    whole = mmap.mmap(-1, (pages + 2) * PAGE)
    start = np.frombuffer(whole, dtype=np.uint8).ctypes.data
    for guard in (start, start + (pages + 1) * PAGE):
        assert _protect(ctypes.c_void_p(guard), PAGE, 0) == 0
    offset = PAGE + (pages * PAGE - array.nbytes if at_end else 0)
    copy = np.frombuffer(whole, array.dtype, array.size, offset).reshape(array.shape)
    copy[...] = array
    return copy


def guard(law, n_nodes):
    """Let the modules of a law and width guard what they align, displacements and rows of addresses."""
    width = lanes.lanes_for(n_nodes)
    for name in (memory, module_for(width, "numerics.memory"), module_for(width, "numerics.memory", law)):
        name._aligned = guarded
    for kernel in {module_for(width, "contact.kernel.loop", law), loop}:
        plain = kernel.Simulation.integrate
        if plain.__name__ != "within_guards":

            def within_guards(self, displacement, first, plain=plain):
                own = guarded(displacement)
                made = plain(self, own, first)
                displacement[:] = own
                return made

            kernel.Simulation.integrate = within_guards
    for kernel in {module_for(width, "extras.rows.kernel", law), row}:
        if kernel.rows_of.__name__ == "rows_of":
            kernel.rows_of = lambda records, plain=kernel.rows_of: guarded(plain(records))


def drawn_blade(rng, n_nodes):
    angle, x = np.sort(rng.uniform(-0.3, 0.3, n_nodes)), np.linspace(-0.02, 0.02, n_nodes)
    radius, cone = 10 ** rng.uniform(-2, 0.5), rng.uniform(-0.4, 0.4)
    slope = rng.normal(size=(n_nodes, 3 * n_nodes + 6)) * 10
    return stand_in.made_blade(rng, rng.uniform(50, 400), x, angle, radius, cone, tip_slope=slope)


def drawn_spec(rng, law):
    change, spec = stand_in.change.__wrapped__(), stand_in.spec.__wrapped__()
    rigid = law.name == "plastic" and rng.random() < 0.25
    E = np.inf if rigid else 10 ** rng.uniform(-1, 3)
    run = {"E": E, "K": np.inf if rigid else E * rng.uniform(0.1, 1.0)}
    run |= {"theta": rng.choice([0.0, rng.uniform(0.0, 0.3)]), "law": str(rng.choice(["theta", "coulomb"]))}
    run |= {"n_elements": int(rng.integers(24, 400)), "half_width": rng.uniform(0.3, 4.0)}
    run |= {"turns": bool(rng.random() < 0.3), "amplitude": 10 ** rng.uniform(-4, -2)}
    run |= {"interference": 10 ** rng.uniform(-5, -2), "displacement_limit": 10 ** rng.uniform(-4, 0)}
    run |= {"initial_displacement": float(rng.choice([0.0, 1e-4])), "start_angle": rng.uniform(-7, 7)}
    run |= {"f_omega": rng.uniform(0.05, 0.4)}
    run |= {"scheme": str(rng.choice(["exponential", "exponential", "central_differences"]))}
    run |= {"steps_per_element": int(rng.integers(1, 40)), "max_time_step": 1e-5}
    return change(spec, element_law=law, **run)


def main(runs, seed, most_nodes, names):
    global at_end
    laws = [described_law(name, PARAMETERS.get(name, {})) for name in names]
    counts = Counter()
    for number in range(runs):
        rng = np.random.default_rng([seed, number])
        law, at_end = laws[number % len(laws)], bool(number // len(laws) % 2)
        n_nodes = int(rng.integers(4, most_nodes + 1)) if law.name == "plastic" else int(rng.integers(4, 9))
        module_of(law)
        guard(law, n_nodes)
        blade, spec = drawn_blade(rng, n_nodes), drawn_spec(rng, law)
        status = "refused"
        with contextlib.suppress(ValueError), np.errstate(all="ignore"):
            if rng.random() < 0.3:
                n_blades = int(rng.integers(1, 4))
                disk = Disk.ring(n_blades, [0.01]) if n_blades > 1 and rng.random() < 0.5 else None
                status = simulate_row(blade, spec, Row.drawn(n_blades, number, 1e-5, 1e-3, disk)).status
            else:
                status = simulate(blade, spec).status
        counts[status] += 1
    print(dict(counts))


if __name__ == "__main__":
    if sys.argv[1] == "provoke":
        ctypes.memset(guarded(np.zeros(8)).ctypes.data + 64, 0, 8)
    main(*map(int, sys.argv[1:4]), sys.argv[4:])
