"""``bladerub fit-coating`` as it is called."""

import numpy as np
import pytest
import yaml

from bladerub.cli import main
from bladerub.config import read
from bladerub.io.folders import base_config


@pytest.fixture
def table(tmp_path):
    """Write a curve of E = 900, K = 60, σ_Y = 9 MPa up to a strain, with noise."""

    def written(highest):
        strain = np.linspace(highest / 40, highest, 40)
        exact = np.minimum(900 * strain, 9 + 900 * 60 / 960 * (strain - 0.01))
        noisy = exact + np.random.default_rng(1).normal(0, 0.05, strain.size)
        path = tmp_path / "curve.csv"
        lines = ["strain,stress (MPa)", *(f"{a},{b}" for a, b in zip(strain, noisy, strict=True))]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return str(path)

    return written


def test_the_lines_are_accepted_by_the_config(table, tmp_path, capsys):
    assert main(["fit-coating", table(0.05)]) == 0
    lines = capsys.readouterr().out.partition("for the config:\n")[2]
    file = tmp_path / "fitted.yaml"
    file.write_text(lines, encoding="utf-8")
    study = read.read(base_config(), file)
    contact, coating = study["contact"], study["coatings"][0]
    assert coating["E"][0] * contact["modulus_unit"] == pytest.approx(900e6, rel=0.02)
    assert coating["K"][0] * contact["modulus_unit"] == pytest.approx(60e6, rel=0.05)
    assert contact["yield_stress"] * contact["modulus_unit"] == pytest.approx(9e6, rel=0.02)
    assert yaml.safe_load(lines)["contact"]["modulus_unit"] == 600e6


def test_what_is_not_determined_is_named(table, capsys):
    assert main(["fit-coating", table(0.008)]) == 0
    assert "not determined by these curves: K, yield_stress" in capsys.readouterr().out
