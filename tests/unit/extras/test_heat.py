from types import SimpleNamespace

import numpy as np
import pytest
import yaml

from bladerub.extras import heat
from bladerub.io.folders import ROOT


@pytest.fixture
def config():
    return yaml.safe_load((ROOT / "config" / "config.yaml").read_text(encoding="utf-8"))


def test_each_case_is_its_run_and_what_grows_is_followed(monkeypatch, config):
    specs = []

    def simulate(blade, spec):
        """Grow faster in the warmth."""
        specs.append(spec)
        law = dict(spec.coating.element_law.parameters)
        rate = 0.0 if spec.coating.theta == 0 else 0.02 if not law else 0.05
        amplitude = 1e-3 * np.exp(rate * np.arange(spec.revolutions))
        rise = np.full((8, 4), 100.0) if law else None
        return SimpleNamespace(
            revolution_amplitude=amplitude,
            status="completed",
            wear=np.full((8, 4), 2e-4),
            layer={} if rise is None else {"temperature_rise": rise},
        )

    monkeypatch.setattr(heat, "simulate", simulate)
    monkeypatch.setattr(heat, "compile_kernel", lambda **given: None)
    table = heat.table(config, SimpleNamespace(f1_hz=200.0, n_interface=8))
    assert list(table.columns) == heat.COLUMNS
    assert list(zip(table.theta, table.conductivity.fillna(0), strict=True)) == [
        (theta, values[0] if values else 0) for theta, values in heat.CASES
    ]
    cold = table.conductivity.isna()
    assert table.max_temperature_rise[~cold].eq(100).all()
    assert table.max_temperature_rise[cold].isna().all()
    longest = config["analysis"]["divergence"]["confirmation_revolutions"]
    assert (table.revolutions == np.where(table.theta > 0, longest, config["solver"]["revolutions"])).all()
    assert (table.divergent == (table.theta > 0)).all()
    np.testing.assert_allclose(
        table.growth_per_revolution[(table.theta > 0) & ~cold], np.expm1(0.05), rtol=1e-6
    )
    assert {spec.f_omega for spec in specs} == {heat.F_OMEGA}
    names = {spec.coating.element_law.name for spec in specs}
    assert names == {"plastic", "thermal"}
