"""Formulas in Python become those of the GPU, or an error that names what cannot."""

import ctypes
import inspect
import subprocess
from types import ModuleType

import numpy as np
import pytest

from bladerub.contact import law as plastic
from bladerub.contact.laws import NAMES, module_of, source_of
from bladerub.contact.spec import ElementLaw, TipProfile
from bladerub.contact.tip import coverage, relief
from bladerub.extras.gpu import batch, emulation, formulas

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
    subprocess.run(
        [emulation.COMPILER, "-O1", "-std=c++17", "-shared", "-fPIC", "-w", "-o", library, text], check=True
    )
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
