"""Drawn configs: Snakemake plans each that passes the checks, and each that does not is refused in lines.

``DRAWN_CONFIGS=300 pytest tests/workflow/test_drawn_configs.py`` draws as many as a night allows.
"""

import collections
import itertools
import os

import pytest
import yaml
from drawn_configs import draw

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, read
from bladerub.io.folders import ROOT

STUDY = ROOT / "config" / "config.yaml"
DRAWN = int(os.environ.get("DRAWN_CONFIGS", 0))


@pytest.fixture
def answer(tmp_path, monkeypatch):
    """Read a config laid over the study: whether it is valid. What is refused has a line for each problem."""
    path = tmp_path / "overlay.yaml"
    monkeypatch.chdir(ROOT)

    def valid(overlay):
        path.write_text(yaml.safe_dump(overlay, allow_unicode=True), encoding="utf-8")
        try:
            read(STUDY, path)
        except ConfigError as error:
            lines = str(error).splitlines()
            assert lines
            assert all(line.startswith((f"{path}", "config", "--config")) for line in lines), lines
            assert max(map(len, lines)) < 1000
            return False
        return True

    return valid


def test_a_wild_config_is_read_or_refused_in_lines(answer):
    study = load(STUDY)
    counts = collections.Counter(answer(draw(study, seed, wild=True)) for seed in range(DRAWN or 60))
    print(f"{counts[True]} valid, {counts[False]} refused")
    assert counts[False] > counts[True]


@pytest.mark.slow
def test_a_config_that_passes_the_checks_is_planned(answer, workspace):
    study = load(STUDY)
    drawn = (draw(study, seed) for seed in itertools.count())
    failed = {}
    for number, overlay in enumerate(itertools.islice(filter(answer, drawn), DRAWN or 6)):
        done = workspace.snakemake("--dry-run", "--quiet", config=overlay)
        if done.returncode:
            failed[number] = (overlay, done.stderr[-600:])
    assert not failed, f"{len(failed)} of {DRAWN or 6}: {failed}"


@pytest.mark.slow
@pytest.mark.parametrize(
    "overlay",
    [
        {"casings": {"2nd": {"nodal_diameters": [3]}}},
        {"casings": {"2nd": {"peak_orders": [8]}}},
        {"speeds": {"start": 0.3, "stop": 0.8, "step": 0.1, "extra": []}, "reduction": {"f_omega_max": 0.8}},
        {"chart": {"casing": "2nd5nd"}},
    ],
)
def test_other_engine_orders_are_planned(workspace, overlay):
    done = workspace.snakemake("all", "chart", "--dry-run", "--quiet", config=overlay)
    assert done.returncode == 0, done.stderr
