import numba
import numpy as np
import pytest
from numba.core.errors import NumbaError
from study_fixtures import changed

from bladerub.contact.spec import PLASTIC, ElementLaw
from bladerub.extras import law_reading
from bladerub.study import grid
from bladerub.study.grid import CoatingCase

LAW = """
from bladerub.contact.law import (
    Element, dissipated_energy, elastic_force, element, return_mapping, stored_energy, tangent
)
PARAMETERS: dict = {"slope": ("Pa", 0.0, 10.0, "a slope")}
"""


def test_the_law_of_the_elements_is_plastic_unless_the_config_names_another_or_a_file(
    config, monkeypatch, tmp_path
):
    def with_law(**law):
        return changed(config, contact={"law": law})

    monkeypatch.setattr(law_reading, "study_folder", lambda: tmp_path)
    case = CoatingCase("2nd", 1.1, 0.5, 0.0)
    wanted = grid.run_spec(config, case, 0.2)
    assert wanted == grid.run_spec(with_law(name="plastic"), case, 0.2)
    assert wanted.coating.element_law == PLASTIC
    other = with_law(name="viscoplastic", viscosity=1e4)
    assert grid.run_spec(other, case, 0.2).coating.element_law.parameters == (("viscosity", 1e4),)
    assert grid.run_spec(other, CoatingCase.rigid("2nd", 0.1), 0.2).coating.element_law == PLASTIC
    (tmp_path / "mine.py").write_text(LAW, encoding="utf-8")
    found = grid.element_law(with_law(file="mine.py", slope=2.0))
    assert (found.name, found.parameters, found.source) == ("mine", (("slope", 2.0),), LAW)
    (tmp_path / "mine.py").write_text(LAW + "# edited\n", encoding="utf-8")
    assert grid.element_law(with_law(file="mine.py", slope=2.0)) != found


def test_a_name_that_is_only_annotated_is_not_there():
    law = LAW.replace("elastic_force, ", "")
    with pytest.raises(ValueError, match="has no elastic_force; a law must have"):
        law_reading.parameters_of(f"{law}elastic_force: object\n")
    for line in ("elastic_force: object = element", "if True:\n    elastic_force = element"):
        assert law_reading.parameters_of(f"{law}{line}\n").keys() == {"slope"}


def test_the_innermost_of_what_the_compiler_repeats_for_each_caller_is_told():
    inner = numba.njit(lambda x: np.vander(x) + x.missing)
    outer = numba.njit(lambda x: inner(x) + 1.0)
    with pytest.raises(NumbaError) as refused:
        outer(1.0)
    problem = str(law_reading.compile_error(ElementLaw("own"), refused.value))
    assert problem.startswith("law own: cannot be compiled (")
    assert "outer" not in problem
    assert problem.count(f'test_law_reading.py", line {inner.py_func.__code__.co_firstlineno}); ') == 1
