import itertools
from pathlib import Path

import pytest

from bladerub.contact import law
from bladerub.contact.setup import compile_kernel
from bladerub.contact.spec import PLASTIC, Coating, ElementLaw
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.extras.verification import element_law
from bladerub.extras.verification.element_law import HISTORIES, TIME_STEPS, check_law
from bladerub.io.errors import BadInput

PAPER = Path(law.__file__).read_text(encoding="utf-8")
DENSIFYING = Path(__file__).parents[4] / "docs" / "laws" / "densifying.py"
COATINGS = [
    Coating(E, K, 0.0, 1.5e-8, 600e6, 6e-3, 2000) for E, K in ((0.05, 10.0), (20.0, 0.05), (1.1, 0.5))
]
RIGHT = [
    PLASTIC,
    described_law("perfectly_plastic", {"yield_stress": 1e6}),
    described_law("viscoplastic", {"viscosity": 1e4}),
    described_law("brittle", {"break_strain": 5e-3}),
    described_law("thermal", LAYER),
    described_law("densifying", {"doubling": 1e-4}, DENSIFYING.read_text(encoding="utf-8")),
]
FORCE = "return maximum(trial - element.elastic * increment, 0.0), increment"
PLASTIC_SLOPE = "plastic = element.elastic * element.plastic_compliance * element.hardening"
TANGENT = "tangent is not the derivative of the force, as far as it says"
RISING = """force = maximum(trial - element.elastic * increment, 0.0)
    return where(increment > 0.0, force, 1.5 * force), increment"""


@pytest.fixture(autouse=True)
def compiled(monkeypatch):
    laws = []
    monkeypatch.setattr(element_law, "compile_kernel", lambda law: laws.append(law))
    return laws


@pytest.mark.parametrize(
    ("law", "coating"), [*zip(RIGHT, itertools.cycle(COATINGS))], ids=lambda value: getattr(value, "name", "")
)
def test_a_law_that_is_right_has_no_problem_and_is_compiled(law, coating, compiled):
    report = check_law(law, [coating])
    assert report.problems == {}
    assert report.histories == HISTORIES * len(TIME_STEPS)
    assert compiled == [law]


@pytest.mark.nightly
def test_what_the_compiler_refuses_is_named_with_its_line():
    source = RIGHT[-1].source.replace("(slope + sqrt(", "(slope + 0.0 * np.log1p(slope) + sqrt(")
    line = source[: source.index("log1p")].count("\n") + 1
    with pytest.raises(BadInput, match=rf"law own.*can't resolve ufunc log1p.*line {line}\)"):
        compile_kernel(law=ElementLaw("own", RIGHT[-1].parameters, source))


def test_what_is_wrong_with_a_law_is_told(compiled, monkeypatch):
    for right, wrong, wanted in (
        (FORCE, RISING, "energy is created: a cycle gives back more than it takes"),
        (FORCE, RISING, "elastic_force after wear is not the force"),
        (FORCE, FORCE.replace("- element", "- 2.0 * element"), "force or wear falls as the depth grows"),
        (PLASTIC_SLOPE, "plastic = element.elastic", TANGENT),
        ("return stiffness, element.elastic_compliance *", "return 2.0 * stiffness, 0.0 *", TANGENT),
    ):
        monkeypatch.setattr(element_law, "TIME_STEPS", (1e-6,))
        assert PAPER.count(right) == 1
        report = check_law(ElementLaw("own", (), PAPER.replace(right, wrong)), COATINGS)
        assert wanted in report.problems
        assert compiled == []
