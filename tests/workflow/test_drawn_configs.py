"""Configs drawn from wild values, each refused in lines or read; other engine orders are planned."""

import math
import random

import pytest
import yaml

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, read
from bladerub.io.folders import ROOT

STUDY = ROOT / "config" / "config.yaml"
WILD = [
    *(None, True, "", "x", "020", "1:30", "1,5", "../x", "ü\u202e", "~", "x" * 2000, "é" * 300),
    *(math.nan, math.inf, -1, 0, 0.5, 1e-320, 1e308, 10**30, 10**400, 2**63),
    *([], {}, [[]], [None], [1] * 3000, {"x": {"x": {}}}, {"": 0}, ["a", {"b": [1, 2]}], {"file": "x"}),
]


def groups(config):
    """Yield each group and list of a config."""
    yield config
    for value in config.values() if isinstance(config, dict) else config:
        if value and isinstance(value, dict | list):
            yield from groups(value)


@pytest.mark.parametrize("seed", range(3))
def test_a_wild_config_is_read_or_refused_in_lines(tmp_path, monkeypatch, seed):
    monkeypatch.chdir(ROOT)
    path, chance, refused = tmp_path / "overlay.yaml", random.Random(seed), 0
    for _ in range(20):
        config = load(STUDY)
        for _ in range(chance.randint(1, 4)):
            group = chance.choice(list(groups(config)))
            key = chance.choice(list(group) if isinstance(group, dict) else range(len(group)))
            group[key] = chance.choice(WILD)
        path.write_text(yaml.safe_dump(config, allow_unicode=True), encoding="utf-8")
        try:
            read(STUDY, path)
        except ConfigError as error:
            lines = str(error).splitlines()
            assert lines
            assert all(line.startswith((f"{path}", "config", "--config")) for line in lines), lines
            assert max(map(len, lines)) < 1000
            refused += 1
    assert refused > 10


@pytest.mark.parametrize(
    "overlay",
    [
        {"casings": {"2nd": {"nodal_diameters": [3]}}},
        {"speeds": {"start": 0.3, "stop": 0.8, "step": 0.1, "extra": []}, "reduction": {"f_omega_max": 0.8}},
    ],
)
def test_other_engine_orders_are_planned(workspace, overlay):
    done = workspace.snakemake("all", "chart", "--dry-run", "--quiet", config=overlay)
    assert done.returncode == 0, done.stderr
