"""Bad configs through the real command: one line each, before any job starts, and nothing is written."""

from __future__ import annotations

import pytest


def section(span, **changes):
    plain = {"chord": 0.085, "thickness": 0.08, "camber": 30, "stagger": 30, "sweep": 0, "lean": 0}
    return plain | {"span": span} | changes


def coatings(**changes):
    return {"coatings": [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]} | changes]}


CASING = {
    "nodal_diameters": [2],
    "weights": [1],
    "amplitude": 0.001,
    "interference": 0.0003,
    "start_angle": 0,
}

BAD = {
    "unknown key": (
        {"contact": {"damping": 0.01}},
        "config: contact.damping = 0.01: unknown key, did you mean contact.damping_ratio?",
    ),
    "number is text": (
        {"reduction": {"f_omega_max": "high"}},
        'config: reduction.f_omega_max = "high": highest speed of the reduced model must be a '
        "number from 0.01 to 2 "
        "(normalised)",
    ),
    "number with its unit": (
        {"blade": {"length": "200 mm"}},
        'config: blade.length = "200 mm": blade length must be a number from 0.01 to 3, in m, '
        "the number alone",
    ),
    "millimetres for metres": (
        {"blade": {"length": 200}},
        "config: blade.length = 200: blade length must be a number from 0.01 to 3, in m",
    ),
    "not a number": (
        {"solver": {"max_time_step": float("nan")}},
        "config: solver.max_time_step = nan: largest time step must be a number from 1e-09 to 0.0001, in s",
    ),
    "infinite": (
        {"contact": {"modulus_unit": float("inf")}},
        "config: contact.modulus_unit = inf: unit of the normalised moduli must be a number "
        "from 1000 to 1e+12, in Pa",
    ),
    "truth for a number": (
        {"solver": {"revolutions": True}},
        "config: solver.revolutions = True: revolutions of a run must be a whole number from 1 to 10000",
    ),
    "nothing for a number": (
        {"blade": {"hub_radius": None}},
        "config: blade.hub_radius = None: hub radius must be a number from 0.01 to 5, in m",
    ),
    "sections out of order": (
        {"blade": {"sections": [section(0), section(0.6), section(0.5), section(1)]}},
        "config: blade.sections[2].span = 0.5: must be above that of the section before (0.6)",
    ),
    "mesh turned inside out": (
        {
            "blade": {
                "sections": [
                    section(0, thickness=0.4),
                    section(0.1, thickness=0.01),
                    section(0.2, thickness=0.01),
                    section(1, thickness=0.4),
                ]
            }
        },
        "config: blade.sections: mesh turned inside out at span 0.1 to 0.15; chord and "
        "thickness must stay above zero "
        "between the sections, and neighbours must not cross",
    ),
    "speed above the reduced model's": (
        {"speeds": {"extra": [0.197, 0.41]}},
        "config: speeds.extra[1] = 0.41: must be at most reduction.f_omega_max = 0.4 "
        "(normalised), the reduced blade is "
        "not valid above",
    ),
    "E of nothing": (
        coatings(E=[2, -0.11]),
        "config: coatings[0].E[1] = -0.11: Young modulus must be a number above 0 and at most "
        "1e+06 (normalised)",
    ),
    "negative K": (
        coatings(K=[0.5, -1]),
        "config: coatings[0].K[1] = -1: plastic modulus must be a number from 0 to 1e+06 (normalised)",
    ),
    "coating listed twice": (
        {"coatings": coatings()["coatings"] + coatings(E=[1, 2], theta=[0.15])["coatings"]},
        "config: coatings[1]: 2nd_E2_K0.5_theta0.15 is listed twice; list each coating once",
    ),
    "E of the rigid casing": (
        {"coatings": [{"casing": "2nd", "coating": "rigid", "friction": [0], "E": [2]}]},
        "config: coatings[0].E = [2]: unknown key, known here: casing, coating, friction",
    ),
    "friction of an abradable coating": (
        coatings(friction=[0.1]),
        "config: coatings[0].coating: missing, kind of coating must be rigid, with friction; an "
        "abradable coating has neither key",
    ),
    "negative friction": (
        {"coatings": coatings()["coatings"] + [{"casing": "2nd", "coating": "rigid", "friction": [-0.1]}]},
        "config: coatings[1].friction[0] = -0.1: coefficient of friction must be a number from 0 to 1",
    ),
    "unknown casing": (
        {"coatings": coatings()["coatings"] + coatings(casing="3nd")["coatings"]},
        'config: coatings[1].casing = "3nd": must be one of the casings, 2nd, 2nd5nd',
    ),
    "casing named like a path": (
        {"casings": {"../2nd": CASING}},
        'config: casings["../2nd"]: name of a casing must be letters and digits only, it '
        "becomes part of file names",
    ),
    "results outside the repository": (
        {"results": "../elsewhere"},
        'config: results = "../elsewhere": results folder must be a folder below the one '
        "Snakemake runs in, of letters, "
        'digits and _ . - only, without ".."',
    ),
    "history of no run": (
        {"analysis": {"histories": [{"casing": "2nd", "E": 2, "K": 0.5, "theta": 0, "f_omega": 0.1911}]}},
        "config: analysis.histories[0].f_omega = 0.1911: must be one of the speeds, add it to "
        "speeds.extra or drop it "
        "here",
    ),
    "window upside down": (
        {"analysis": {"peaks": {"speed_window": [1.25, 0.85]}}},
        "config: analysis.peaks.speed_window = [1.25, 0.85]: must be the lower end first, then the upper",
    ),
    "weight for no nodal diameter": (
        {"casings": {"2nd": {"weights": [1, 2]}}},
        "config: casings.2nd.weights = [1, 2]: must be 1, one for each of nodal_diameters",
    ),
}


def lines_of_ours(stderr: str) -> list[str]:
    """Snakemake says that it lays one config over the other; all else must be ours."""
    return [
        line
        for line in stderr.splitlines()
        if not line.startswith("Config file config/config.yaml is extended")
    ]


@pytest.mark.parametrize("fault", BAD)
def test_bad_config_is_answered_in_one_line(workspace, fault):
    config, line = BAD[fault]
    done = workspace.snakemake("--cores", "1", config=config)
    assert lines_of_ours(done.stderr) == [line]
    assert done.stdout == ""
    assert done.returncode != 0
    assert not (workspace.folder / "results").exists()


def test_all_faults_are_told_at_once(workspace):
    done = workspace.snakemake("--cores", "1", config={"blade": {"length": 200}, "coating": []})
    assert [line.split("=")[0] for line in lines_of_ours(done.stderr)] == [
        "config: coating ",
        "config: blade.length ",
    ]


def test_malformed_yaml_is_answered_with_file_and_line(workspace):
    path = workspace.folder / "config" / "config.yaml"
    path.write_text("results: results\nblade: [1\ncontact: 2\n")
    done = workspace.snakemake("--cores", "1")
    (line,) = done.stderr.splitlines()
    assert line.startswith("config: config/config.yaml, line 3: not valid YAML")
    assert done.returncode != 0
    assert not (workspace.folder / "results").exists()


def test_malformed_overlay_is_answered_without_traceback(workspace):
    done = workspace.snakemake("--cores", "1", config="blade: [1\ncontact: 2\n")
    assert "not valid JSON or YAML" in done.stderr
    assert "Traceback" not in done.stderr
    assert done.returncode != 0


def test_numbers_of_any_spelling_are_numbers(workspace):
    spellings = "solver: {max_time_step: 25e-8}\nblade: {material: {young_modulus: 1.1e11}}\n"
    done = workspace.snakemake("--dry-run", config=spellings)
    assert done.returncode == 0, done.stderr
