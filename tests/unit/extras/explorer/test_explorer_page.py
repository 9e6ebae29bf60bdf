import base64
import dataclasses
import gzip
import hashlib
import json
import re

import numpy as np
import pandas as pd
import pytest

from bladerub.extras.explorer.coating import AMPLITUDE_FLOOR, parts
from bladerub.extras.explorer.page import build
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import write_manifest
from bladerub.study.maps import write_map

SETTINGS = {
    "max_frequency": 2.5,
    "amplitude_range": [2e-6, 3e-3],
    "growth_revolutions": 10,
    "spectrum_revolutions": 10,
    "modulus_unit": 6e8,
    "doubts": ["eq. (2) is up to 3.9 % off"],
}


@pytest.fixture
def page(coating, verdicts, runs, tmp_path):
    """Make the page of some coatings that share all but their case."""

    def make(*coatings):
        maps, manifests, tables, peaks = [], [], [], []
        for index, each in enumerate(coatings):
            maps.append(tmp_path / f"{index}.h5")
            manifests.append(tmp_path / f"{index}.tsv")
            write_map(maps[-1], each, {})
            write_manifest(manifests[-1], runs)
            case = dataclasses.asdict(each.case)
            tables.append(verdicts.assign(**case))
            peaks.append(case | {"order": 4, "f_peak": 0.2, "amplitude": 1.25e-3})
        return build(maps, manifests, pd.DataFrame(peaks), pd.concat(tables), SETTINGS, [])

    return make


def scripts(page, kind):
    return re.findall(rf'<script type="{kind}"[^>]*>(.*?)</script>', page, re.DOTALL)


def test_what_is_packed_comes_back(coating, verdicts, runs):
    packed = parts(coating, verdicts, runs, 10, max_frequency=2.5)
    data = {name: gzip.decompress(base64.b64decode(text)) for name, text in packed.items()}
    numbers = json.loads(data["figures"])

    steps = np.cumsum(np.frombuffer(data["wear"], np.uint8).reshape(3, 60), axis=1, dtype=np.uint8)
    deepest = np.array(numbers["deepest"])[:, None]
    assert (np.abs(steps / 255 * deepest - 1e3 * coating.wear) <= deepest / 509).all()

    low, high = numbers["spectrum_range"]
    codes = np.frombuffer(data["spectrum"], np.uint8)[:252]  # to order 25 at the first speed, and a cell
    amplitude = low * (high / low) ** ((codes - 1.0) / 254)
    shown = 1e3 * np.maximum(coating.spectrum_amplitude[0, :252], AMPLITUDE_FLOOR)
    np.testing.assert_allclose(amplitude, shown, rtol=0.03)
    assert not np.frombuffer(data["spectrum"], np.uint8)[-132:].any()  # the last run has no spectrum

    low, high = numbers["growth_range"]
    codes = np.frombuffer(data["growth"], "<u2").reshape(3, 50)
    amplitude = np.where(codes, low * (high / low) ** ((codes - 1.0) / 65534), np.nan)
    np.testing.assert_allclose(amplitude[:, :20], 1e3 * coating.revolution_amplitude, rtol=1e-3)
    np.testing.assert_allclose(amplitude[:, 20:], 1e3 * coating.confirmation_amplitude, rtol=1e-3)
    assert numbers["runs"]["growth_per_revolution"] == verdicts["growth_per_revolution"].tolist()


def test_the_page_holds_every_coating_and_needs_nothing_else(page, coating):
    other = dataclasses.replace(coating, case=CoatingCase.rigid("2nd", 0.0))
    text = page(coating, other)
    (study,) = scripts(text, "application/json")
    first, second = json.loads(study)["coatings"]
    assert (first["name"], first["title"]) == (coating.case.name, "casing 2nd, E = 2, K = 0.5, θ = 0.15 rad")
    assert (second["E"], second["rigid"], second["friction"]) == (None, True, 0.0)
    without = {"reason": None, "draws": None, "low": None, "high": None}
    assert first["peaks"] == [{"order": 4, "f": 0.2, "Y": 1.25} | without]
    assert len(scripts(text, "application/gzip")) == 8
    assert re.findall(r"<(?:script|link|img|iframe)[^>]*\b(?:src|href)=", text) == []
    assert text == page(coating, other)


def test_the_policy_lets_only_its_own_scripts_run(page, coating):
    text = page(coating)
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    programs = re.findall(r"<script>(.*?)</script>", text, re.DOTALL) + scripts(text, "module")
    digests = [base64.b64encode(hashlib.sha256(each.encode()).digest()).decode() for each in programs]
    assert len(digests) == 2
    assert f"script-src 'sha256-{digests[0]}' 'sha256-{digests[1]}';" in policy
    assert policy.startswith("default-src 'none';")


def test_a_hostile_name_adds_no_markup(page, coating):
    hostile = '</script><script>alert(1)</script><img src="x">'
    text = page(dataclasses.replace(coating, case=CoatingCase(hostile, 2.0, 0.5, 0.15)))
    assert "alert(1)</script>" not in text
    assert "<img" not in text.split("<script>")[0]
    (study,) = scripts(text, "application/json")
    assert json.loads(study)["coatings"][0]["casing"] == hostile
