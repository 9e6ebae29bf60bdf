import json

import pytest

pytestmark = pytest.mark.slow


@pytest.mark.nightly
def test_json_holds_every_figure(on_six_runs):
    code, out, _ = on_six_runs("benchmark", "--json", "--rounds", "1", "--cores", "2")
    assert code == 0
    told = json.loads(out)
    assert 0.2 < told["contact_share"] < 0.5
    for loop, rates in told["steps_per_second"].items():
        assert rates["free"] > rates["contact"] > 0, loop
    assert told["ratio_to_numpy"] > told["ratio_to_numba"] > 1
    assert all(0 < told[f"fraction_of_peak_{part}"] < 1 for part in ("contact", "free"))
    assert (told["runs"], told["cores"]) == (6, 2)
    assert told["study_minutes"] * 2 * 60 > 6 * told["seconds_per_run"] > 0


def test_bad_input_is_answered_in_one_line(on_six_runs):
    code, _, error = on_six_runs("benchmark", "--nodes", "16", "33")
    assert code == 2
    assert "--nodes 33: must be from 4 to 32" in error
    assert error.count("\n") == 1
