import pytest

MEASURES = {"wear_l2", "peak", "revolution_peak"}


@pytest.fixture
def verified(figures, six_runs):
    return lambda *words: figures("verify", *six_runs, "--seed", "1", *words)


def test_json_holds_every_figure_whatever_the_jobs(verified):
    told = verified("--sample", "2")
    assert (told["n"], told["seed"], told["jobs"]) == (2, 1, 1)
    assert 0 <= told["within_1_percent"] <= 1
    for measure in MEASURES:
        assert told[measure].keys() == {"median", "p95", "max"}
        assert 0 <= told[measure]["median"] <= told[measure]["p95"] <= told[measure]["max"] < 1
    assert told["against_paper_scheme"].keys() == MEASURES | {"uncertainty"}
    by_two = verified("--sample", "2", "--jobs", "2")
    for key in ("n", "within_1_percent", "beyond", "worst", *MEASURES, "energy_residual"):
        assert by_two[key] == told[key]


def test_runs_beyond_one_percent_are_named(verified, folder):
    config = folder / "coarse.yaml"
    config.write_text("solver: {steps_per_element: 1, max_time_step: 1e-4}\n")
    told = verified("--sample", "6", "--config", config)
    assert told["beyond"]
    for entry in told["beyond"]:
        assert entry["name"].startswith(f"2nd_E{entry['E']:g}_K0.5_theta0.15/{entry['f_omega']:.4f}")
        assert max(entry[measure] for measure in MEASURES) > 0.01
        assert entry["spread"].keys() == MEASURES
        assert isinstance(entry["sensitive"], bool)


def test_rows_of_blades_are_drawn_from_their_plan(verified, folder):
    plan = folder / "rotor.yaml"
    some = "casing: 2nd, E: 2, K: 0.5, theta: 0.15, f_omega: [0.2, 0.3], blades: [2], length_scatter: [5e-5]"
    some += ", frequency_scatter: [0.01], coupling: [0, 0.01], draws: 4"
    plan.write_text(f"seed: 1\ngroups: {{some: {{{some}}}}}\n")
    told = verified("--rows", plan, "--sample", "3")
    assert told["n"] == 3
    assert told["energy_residual"]["max"] < 1e-3
    assert told["worst"]["wear_l2"].startswith("2nd_E2_K0.5_theta0.15_f0.")


@pytest.mark.slow
@pytest.mark.nightly
def test_json_holds_every_figure(figures, six_runs):
    told = figures("benchmark", *six_runs, "--rounds", "1", "--cores", "2")
    assert 0.2 < told["contact_share"] < 0.5
    for loop, rates in told["steps_per_second"].items():
        assert rates["free"] > rates["contact"] > 0, loop
    assert told["ratio_to_numpy"] > told["ratio_to_numba"] > 1
    assert all(0 < told[f"fraction_of_peak_{part}"] < 1 for part in ("contact", "free"))
    assert (told["runs"], told["cores"]) == (6, 2)
    assert told["study_minutes"] * 2 * 60 > 6 * told["seconds_per_run"] > 0
