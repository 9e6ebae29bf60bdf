import tomllib
from collections import defaultdict
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LONGEST = 15
"""Most lines that two passages may have in common, blank ones not counted."""


def test_no_passage_of_the_sources_is_there_twice():
    places = defaultdict(list)
    for path in sorted(path for end in ("py", "smk") for path in (ROOT / "src").rglob(f"*.{end}")):
        lines = path.read_text(encoding="utf-8").splitlines()
        numbered = [(number, line.strip()) for number, line in enumerate(lines, 1) if line.strip()]
        for first in range(len(numbered) - LONGEST):
            passage = tuple(line for _, line in numbered[first : first + LONGEST + 1])
            places[passage].append(f"{path.relative_to(ROOT)}:{numbered[first][0]}")
    assert [repeated for repeated in places.values() if len(repeated) > 1] == []


@pytest.mark.extras
def test_the_faults_of_the_mutation_list_can_be_put_in():
    faults = tomllib.loads((ROOT / ".ci" / "mutation" / "named.toml").read_text(encoding="utf-8"))["fault"]
    assert {f["name"] for f in faults if (ROOT / f["file"]).read_text().count(f["before"]) != 1} == set()
