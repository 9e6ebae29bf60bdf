import ctypes
import inspect
import math
import subprocess
from types import ModuleType

import numpy as np
import pytest

from bladerub.contact import law as plastic
from bladerub.contact.laws import NAMES, module_of, source_of
from bladerub.contact.setup import set_up
from bladerub.contact.spec import ElementLaw, TipProfile
from bladerub.contact.tip import coverage, relief
from bladerub.extras.gpu import batch, emulation, formulas
from bladerub.extras.gpu.batch import refusal, variant_of
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"E": math.inf, "K": math.inf}, "rigid casing"),
        ({"law": "coulomb"}, "Coulomb"),
        ({"scheme": "central_differences", "max_time_step": 2e-6}, "central_differences corrects"),
        ({"element_law": described_law("thermal", LAYER)}, "thermal conducts heat"),
        ({}, ""),
    ],
)
def test_what_the_loop_can_not_do_is_said(values, reason, blade, spec, change):
    changed = change(spec, **values)
    told = refusal(changed, set_up(blade, changed)[1])
    assert reason in told
    assert bool(told) == bool(values)


def test_the_window_of_elements_is_wide_enough_and_runs_of_other_sizes_have_the_same_program(
    blade, spec, change
):
    for half_width in (1.0, 2.0, 2.5, 3.0, 6.0):
        changed = change(spec, half_width=half_width)
        rows = 4 * variant_of(changed, set_up(blade, changed)[1]).rows
        farthest = rows - 2 * half_width - 1.5  # as in ``loop.cu``
        assert math.floor(2 * half_width + farthest) + 2 <= rows  # at the worst place
        assert farthest >= 0.5

    def source_for(**changes):
        changed = change(spec, **changes)
        return batch.source(variant_of(changed, set_up(blade, changed)[1]))

    same = source_for(half_width=1.2)
    assert source_for(half_width=1.3) == same
    assert source_for(half_width=1.2, n_elements=1500, revolutions=3) == same
    assert source_for(half_width=2.6) != same


WRAPPED = """
extern "C" void evaluate(int n, const double* parameters, const double* given, double* found) {
  for (int i = 0; i < n; i++) {
    const Element element = load_element(parameters, 0);
    const real depth = given[4 * i], wear = given[4 * i + 1];
    const real before = given[4 * i + 2], offset = given[4 * i + 3];
    const Profile tip{2.0, 5e-6};
    const Pair mapped = return_mapping(element, depth, wear), slope = tangent(element, depth, wear);
    const real results[] = {
        mapped.first, mapped.second, slope.first, slope.second, elastic_force(element, depth),
        stored_energy(element, mapped.first),
        dissipated_energy(element, wear, mapped.second, before, mapped.first),
        coverage(tip, offset), relief(tip, offset)};
    for (int k = 0; k < 9; k++) found[9 * i + k] = results[k].of[0];
  }
}
"""


def compiled(law: ModuleType, source: str, folder):
    lanes = (batch.FOLDER / "lanes.h").read_text()
    text, library = folder / "formulas.cpp", folder / "formulas.so"
    text.write_text("\n".join([lanes, formulas.of_contact(), formulas.of_law(law, source), WRAPPED]))
    options = ["-O1", "-std=c++17", "-shared", "-fPIC", "-w", "-o"]
    subprocess.run([emulation.COMPILER, *options, library, text], check=True)
    return ctypes.CDLL(str(library)).evaluate


@pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
@pytest.mark.parametrize("name", NAMES)
def test_a_formula_gives_what_it_gives_in_python(name, tmp_path):
    law = ElementLaw(name)
    module, source = module_of(law), source_of(law)
    rng = np.random.default_rng(5)
    element = module.Element(*rng.uniform(0.5, 2.0, len(module.Element._fields)))
    given = rng.uniform((-1, 0, 0, -3), (3, 2, 2, 3), (500, 4))
    found = np.empty((500, 9))
    parameters = np.repeat(np.array(element), 8)  # a row of eight for each
    addresses = [each.ctypes.data_as(ctypes.c_void_p) for each in (parameters, given, found)]
    compiled(module, source, tmp_path)(500, *addresses)
    depth, wear, before, offset = given.T
    force, increment = module.return_mapping(element, depth, wear)
    tip = TipProfile(2.0, 20e-6)
    expected = [
        *(force, increment, *module.tangent(element, depth, wear), module.elastic_force(element, depth)),
        module.stored_energy(element, force),
        module.dissipated_energy(element, wear, increment, before, force),
        *(coverage(tip, offset), relief(tip, offset)),
    ]
    np.testing.assert_allclose(found.T, np.array(expected), rtol=1e-13, atol=1e-15)


OWN_LIMIT = "def elastic_limit(element, wear):\n    return wear\n"  # return_mapping has another


@pytest.mark.parametrize(
    ("more", "body", "named"),
    [
        ("", "element.elastic * abs(depth)", "elastic_force: abs"),
        ("", "unheard_of * depth", "elastic_force: unheard_of"),
        (OWN_LIMIT, "elastic_limit(element, depth)", "elastic_limit: two functions of this name"),
    ],
)
def test_what_a_gpu_is_not_given_is_named(more, body, named):
    module, force = ModuleType("law"), f"def elastic_force(element, depth):\n    return {body}\n"
    source = f"from bladerub.contact.law import *\n{more}{force}"
    exec(compile(source, "<law>", "exec"), module.__dict__)
    with pytest.raises(ValueError, match=named):
        formulas.of_law(module, source)


def test_the_functions_are_those_that_the_loop_of_the_processor_calls():
    elements = inspect.getsource(__import__("bladerub.contact.kernel.elements", fromlist=["x"]))
    assert {name for name in dir(plastic) if f"law.{name}(" in elements} <= set(formulas.LAW)
