from types import SimpleNamespace

import numpy as np

from bladerub.extras import heat


def test_each_case_is_its_run_and_what_grows_is_followed(monkeypatch, config):
    specs = []

    def simulate(blade, spec):
        specs.append(spec)
        law = dict(spec.coating.element_law.parameters)
        rate = 0.0 if spec.coating.theta == 0 else 0.02 if not law else 0.05
        amplitude = 1e-3 * np.exp(rate * np.arange(spec.revolutions))
        layer = {"temperature_rise": np.full((8, 4), 100.0)} if law else {}
        wear = np.full((8, 4), 2e-4)
        return SimpleNamespace(revolution_amplitude=amplitude, status="completed", wear=wear, layer=layer)

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
    longest = config.analysis.divergence.confirmation_revolutions
    assert (table.revolutions == np.where(table.theta > 0, longest, config.solver.revolutions)).all()
    assert (table.divergent == (table.theta > 0)).all()
    warm = table.growth_per_revolution[(table.theta > 0) & ~cold]
    np.testing.assert_allclose(warm, np.expm1(0.05), rtol=1e-6)
    assert {spec.f_omega for spec in specs} == {heat.F_OMEGA}
