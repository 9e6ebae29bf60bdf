import random

import pytest
from mutants import find_mutants, sample
from run import ROOT, named_faults


@pytest.mark.parametrize(
    ("source", "kind", "mutated"),
    [
        ("a = b < c", "comparison", {"a = b <= c", "a = b > c"}),
        ("a = b is None", "comparison", {"a = b is not None"}),
        ("a = 'µ' if b + c else d", "arithmetic", {"a = 'µ' if b - c else d"}),
        ("a = b and c and d", "condition", {"a = b or c and d", "a = b and c or d"}),
        ("a = not b", "condition", {"a = b"}),
        ("a = -b", "sign", {"a = b"}),
        ("a = [0.5]", "constant", {"a = [0.52]"}),
        ("a = max(b, key=c)", "extremum", {"a = min(b, key=c)"}),
        ("a = b(c, d, key=e)", "swapped arguments", {"a = b(d, c, key=e)"}),
        ("a = b(c, key=d, other=e)", "dropped argument", {"a = b(c, other=e)", "a = b(c, key=d)"}),
        ("a = [b, c, d]", "dropped element", {"a = [c, d]", "a = [b, d]", "a = [b, c]"}),
        ("a = {b: c, d: e}", "dropped element", {"a = {d: e}", "a = {b: c}"}),
        ("a.b += c", "removed statement", {"pass"}),
    ],
)
def test_each_kind_of_mutant(source, kind, mutated):
    mutants = find_mutants("file.py", source)
    assert {mutant.apply(source) for mutant in mutants if mutant.kind == kind} == mutated


@pytest.mark.parametrize(
    "source",
    ["import a", "def f(a: 1 + 2) -> 3: ...", "@f(a=1)\ndef g(): ...", "a = f'{b + 1}'", "a = b(c, c)"],
)
def test_imports_annotations_decorators_messages_and_equal_arguments_stay(source):
    assert find_mutants("file.py", source) == []


def test_lines_before_and_after():
    source = "a = b(\n    c,\n    d=1,\n)\n"
    (dropped,) = (mutant for mutant in find_mutants("file.py", source) if mutant.kind == "dropped argument")
    assert dropped.lines(source) == (3, "d=1,", "")


def test_a_sample_has_mutants_of_every_file_and_of_rare_kinds():
    frequent = find_mutants("large.py", "a = [" + "1, " * 50 + "-b]") + find_mutants("small.py", "a = b < c")
    drawn = sample(frequent, 10, random.Random(1))
    assert {mutant.file for mutant in drawn} == {"large.py", "small.py"}
    assert "sign" in {mutant.kind for mutant in drawn}
    assert len(drawn) == 10


def test_every_named_fault_changes_its_file():
    faults = named_faults()
    assert len({fault.kind for fault in faults}) == len(faults) > 20
    for fault in faults:
        source = (ROOT / fault.file).read_text(encoding="utf-8")
        assert fault.apply(source) != source
