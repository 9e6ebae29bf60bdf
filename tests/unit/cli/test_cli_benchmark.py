import json
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

PEAKS = Path(__file__).parents[3] / "docs" / "data" / "peaks.csv"

SMALL = """
blade: {mesh: {chordwise: 7, thickness: 1, spanwise: 6}}
reduction: {accuracy_speeds: 3}
contact: {elements: 200}
coatings: [{casing: 2nd, E: [2, 20], K: [0.5], theta: [0.15]}]
speeds: {start: 0.2, stop: 0.4, step: 0.1, extra: []}
solver: {revolutions: 3}
analysis: {spectrum_revolutions: 2, divergence: {revolutions: 3}, histories: []}
"""


@pytest.fixture
def benchmark(folder, at_home):
    (folder / "small.yaml").write_text(SMALL)
    return lambda *arguments: at_home("benchmark", "--config", folder / "small.yaml", *arguments)


@pytest.mark.nightly
def test_json_holds_every_figure(benchmark):
    code, out, _ = benchmark("--json", "--rounds", "1", "--cores", "2")
    assert code == 0
    told = json.loads(out)
    assert 0.2 < told["contact_share"] < 0.5
    for loop, rates in told["steps_per_second"].items():
        assert rates["free"] > rates["contact"] > 0, loop
    assert told["ratio_to_numpy"] > told["ratio_to_numba"] > 1
    assert 0 < told["fraction_of_peak_contact"] < 1
    assert 0 < told["fraction_of_peak_free"] < 1
    assert (told["runs"], told["cores"]) == (6, 2)
    assert told["study_minutes"] * 2 * 60 > 6 * told["seconds_per_run"] > 0
    assert told["vector_bits"] in {64, 128, 256, 512}
    assert told["processor"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--nodes", "16", "33"], "--nodes 33: must be from 4 to 32"),
        (["--table", str(PEAKS)], "peaks.csv: not the right table, processor"),
    ],
)
def test_bad_input_is_answered_in_one_line(benchmark, arguments, message):
    code, _, error = benchmark(*arguments)
    assert code == 2
    assert message in error
    assert error.count("\n") == 1
