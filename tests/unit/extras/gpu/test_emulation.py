import ctypes
import inspect
import math
import subprocess
import sys
from dataclasses import asdict, replace
from functools import cache
from types import ModuleType, SimpleNamespace
from typing import ClassVar
from unittest.mock import MagicMock

import numpy as np
import pytest

from bladerub.contact import law as plastic
from bladerub.contact.laws import NAMES, module_of, source_of
from bladerub.contact.run import simulate
from bladerub.contact.setup import set_up
from bladerub.contact.spec import ElementLaw, TipProfile
from bladerub.contact.tip import coverage, relief
from bladerub.extras.gpu import batch, device, emulation, formulas
from bladerub.extras.gpu.batch import simulate_many
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law

needs_compiler = pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
TOLERANCE = 1e-9  # over the largest number: what both round off (`test_gpu_rounding`)
TOLERANCE_WHERE_IT_GROWS = 1e-7
CASES = {
    "stiff": {"E": 5.0, "K": 5.0, "max_time_step": 1e-6},
    "no_multiple_of_four_elements": {"n_elements": 201},
    "beyond_the_limit": {"displacement_limit": 4e-4, "revolutions": 6},
    "viscoplastic": {"element_law": ElementLaw("viscoplastic", (("viscosity", 1e4),))},
}


def pairs(blade, specs):
    """Results of the emulation, each with that of the processor; none may be left to the latter."""
    told = []
    found = dict(simulate_many(blade, specs, emulation.run, lambda runs, line: told.append(line)))
    assert not told
    return [(found[number], simulate(blade, spec)) for number, spec in enumerate(specs)]


def assert_equal(found, expected, tolerance=TOLERANCE):
    for name in ("status", "message", "n_steps", "n_contact_steps", "n_reversed_steps", "n_modes"):
        assert getattr(found, name) == getattr(expected, name), name
    for name in ("wear", "radial_displacement", "revolution_peak", "revolution_amplitude", "slowest_sliding"):
        given = np.asarray(getattr(expected, name))
        within = tolerance * np.nanmax(np.abs(given), initial=1e-9)  # all may be NaN
        np.testing.assert_allclose(getattr(found, name), given, rtol=0, atol=within, err_msg=name)
    given = asdict(expected.energy)
    assert asdict(found.energy) == pytest.approx(given, abs=tolerance * max(map(abs, given.values())))


@needs_compiler
@pytest.mark.nightly
@pytest.mark.parametrize("case", CASES)
def test_the_loop_of_the_gpu_makes_the_steps_of_the_processors(case, blade, spec, change):
    ((found, expected),) = pairs(blade, [change(spec, **CASES[case])])
    assert expected.n_contact_steps > 100
    assert_equal(found, expected, TOLERANCE_WHERE_IT_GROWS if case == "stiff" else TOLERANCE)


@needs_compiler
@pytest.mark.nightly
def test_a_profile_that_turns(blade, spec, change):
    slope = np.random.default_rng(3).normal(scale=3.0, size=(8, len(blade.mass)))
    turning = replace(blade, tip_slope=slope)
    specs = [change(spec, turns=True, theta=theta) for theta in (0.0, 0.1)]
    for found, expected in pairs(turning, specs):
        assert expected.energy.work_couple != 0
        assert_equal(found, expected)


@needs_compiler
def test_runs_beside_each_other_are_those_alone_and_of_the_processor(blade, spec, change):
    specs = [change(spec, f_omega=0.2, E=0.5), change(spec, theta=0.0, revolutions=3)]
    specs += [change(spec, revolutions=5)]
    for each, (found, expected) in zip(specs, pairs(blade, specs), strict=True):
        assert_equal(found, expected, TOLERANCE_WHERE_IT_GROWS)
        ((_, alone),) = simulate_many(blade, [each], emulation.run)
        np.testing.assert_array_equal(found.wear, alone.wear)
        np.testing.assert_array_equal(found.radial_displacement, alone.radial_displacement)
        assert found.energy == alone.energy


class Array(np.ndarray):
    """With the memory that CuPy gives an array."""

    @property
    def data(self):
        memory = np.asarray(self).reshape(-1).view(np.uint8)
        return SimpleNamespace(
            ptr=self.ctypes.data, memset_async=lambda value, size: memory[:size].fill(value)
        )


class Kernel:
    """The emulation; lists the grids of its launches."""

    grids: ClassVar = []

    def __init__(self, source):
        self.source = source

    def __call__(self, grid, block, arguments, shared_mem):
        self.grids.append(grid)
        assert block == (32,)
        assert shared_mem == self.max_dynamic_shared_size_bytes > 0
        n_runs, *arrays = arguments
        emulation.call(emulation._compiled(self.source, "double"), int(n_runs), *arrays)


@pytest.fixture
def cupy(monkeypatch):
    monkeypatch.setattr(device, "_compiled", cache(device._compiled.__wrapped__))
    monkeypatch.setattr(Kernel, "grids", [])
    module = MagicMock(asnumpy=np.array)
    module.asarray = lambda given: np.array(given).view(Array)
    module.empty = lambda shape, dtype: np.empty(shape, dtype).view(Array)
    module.RawModule = lambda code, options: SimpleNamespace(get_function=lambda name: Kernel(code))
    attributes = {"MultiProcessorCount": 2}
    module.cuda.Device.return_value = SimpleNamespace(mem_info=(0, 10**9), attributes=attributes)
    module.cuda.runtime.CUDARuntimeError = RuntimeError
    monkeypatch.setitem(sys.modules, "cupy", module)
    return module


@needs_compiler
def test_runs_of_several_sizes_share_a_kernel(cupy, blade, spec, change):
    sizes = [{"revolutions": 2}, {"n_elements": 150}, {"displacement_limit": 4e-4, "revolutions": 6}]
    sizes += [{"half_width": 2.6}]
    specs = [change(spec, **size) for size in sizes]
    found = dict(simulate_many(blade, specs, device.run))
    for number, each in enumerate(specs):
        expected = simulate(blade, each)
        np.testing.assert_allclose(found[number].wear, expected.wear, rtol=0, atol=1e-9)
        whole = expected.radial_displacement  # NaN beyond the limit
        np.testing.assert_allclose(found[number].radial_displacement, whole, rtol=0, atol=1e-9)
        assert found[number].n_steps == expected.n_steps
    assert Kernel.grids == [(3,), (1,)]


def test_without_a_gpu_it_is_said(cupy):
    cupy.cuda.runtime.getDeviceCount.side_effect = RuntimeError("no driver")
    with pytest.raises(device.NoGpuError, match="no driver"):
        device.connect()


def test_the_window_is_wide_enough_other_sizes_have_the_same_program_and_what_can_not_be_done_is_said(
    blade, spec, change
):
    for half_width in (1.0, 2.0, 2.5, 3.0, 6.0):
        changed = change(spec, half_width=half_width)
        rows = 4 * batch.variant_of(changed, set_up(blade, changed)[1]).rows
        farthest = rows - 2 * half_width - 1.5  # as in ``loop.cu``
        assert math.floor(2 * half_width + farthest) + 2 <= rows  # at the worst place
        assert farthest >= 0.5

    def source_for(**changes):
        changed = change(spec, **changes)
        return batch.source(batch.variant_of(changed, set_up(blade, changed)[1]))

    same = source_for(half_width=1.2)
    assert source_for(half_width=1.3) == same
    assert source_for(half_width=1.2, n_elements=1500, revolutions=3) == same
    assert source_for(half_width=2.6) != same
    refused = [{"E": math.inf, "K": math.inf}, {"law": "coulomb"}, {"scheme": "central_differences"}]
    refused[-1]["max_time_step"] = 2e-6
    for values in (*refused, {"element_law": described_law("thermal", LAYER)}, {}):
        changed = change(spec, **values)
        assert bool(batch.refusal(changed, set_up(blade, changed)[1])) == bool(values)


WRAPPED = """
extern "C" void evaluate(int n, const double* parameters, const double* given, double* found) {
  for (int i = 0; i < n; i++) {
    const Element element = load_element(parameters, 0);
    const real depth = given[4 * i], wear = given[4 * i + 1];
    const real before = given[4 * i + 2], offset = given[4 * i + 3];
    const Profile tip{2.0, 5e-6};
    const Pair mapped = return_mapping(element, depth, wear), slope = tangent(element, depth, wear);
    const real results[] = {
        mapped.first, mapped.second, slope.first, slope.second, elastic_force(element, depth, wear),
        stored_energy(element, mapped.first),
        dissipated_energy(element, wear, mapped.second, before, mapped.first),
        coverage(tip, offset), relief(tip, offset)};
    for (int k = 0; k < 9; k++) found[9 * i + k] = results[k].of[0];
  }
}
"""


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
def test_a_formula_gives_what_it_gives_in_python(name, tmp_path):
    law, text, library = ElementLaw(name), tmp_path / "formulas.cpp", tmp_path / "formulas.so"
    module, lanes = module_of(law), (batch.FOLDER / "lanes.h").read_text()
    of_law = formulas.of_law(module, source_of(law))
    text.write_text("\n".join([lanes, formulas.of_contact(), of_law, WRAPPED]))
    options = ["-O1", "-std=c++17", "-shared", "-fPIC", "-w", "-o"]
    subprocess.run([emulation.COMPILER, *options, library, text], check=True)
    rng = np.random.default_rng(5)
    element = module.Element(*rng.uniform(0.5, 2.0, len(module.Element._fields)))
    given = rng.uniform((-1, 0, 0, -3), (3, 2, 2, 3), (500, 4))
    found = np.empty((500, 9))
    parameters = np.repeat(np.array(element), 8)  # a row of eight for each
    addresses = [each.ctypes.data_as(ctypes.c_void_p) for each in (parameters, given, found)]
    ctypes.CDLL(str(library)).evaluate(500, *addresses)
    depth, wear, before, offset = given.T
    force, increment = module.return_mapping(element, depth, wear)
    tip = TipProfile(2.0, 20e-6)
    expected = [
        *(force, increment, *module.tangent(element, depth, wear)),
        module.elastic_force(element, depth, wear),
        module.stored_energy(element, force),
        module.dissipated_energy(element, wear, increment, before, force),
        *(coverage(tip, offset), relief(tip, offset)),
    ]
    np.testing.assert_allclose(found.T, np.array(expected), rtol=1e-13, atol=1e-15)


def test_what_a_gpu_is_not_given_is_named():
    own_limit = "def elastic_limit(element, wear):\n    return wear\n"  # return_mapping has another
    for more, body, named in (
        ("", "element.elastic * abs(depth)", "elastic_force: abs"),
        ("", "unheard_of * depth", "elastic_force: unheard_of"),
        (own_limit, "elastic_limit(element, depth)", "elastic_limit: two functions of this name"),
    ):
        module, force = ModuleType("law"), f"def elastic_force(element, depth, wear):\n    return {body}\n"
        source = f"from bladerub.contact.law import *\n{more}{force}"
        exec(compile(source, "<law>", "exec"), module.__dict__)
        with pytest.raises(ValueError, match=named):
            formulas.of_law(module, source)
    elements = inspect.getsource(__import__("bladerub.contact.kernel.elements", fromlist=["x"]))
    assert {name for name in dir(plastic) if f"law.{name}(" in elements} == set(formulas.LAW)
