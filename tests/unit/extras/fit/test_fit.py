import numpy as np
import pytest

from bladerub.contact import law
from bladerub.contact.spec import Coating
from bladerub.extras.fit.curves import Curve, read
from bladerub.extras.fit.fit import fit, stress
from bladerub.io.errors import BadInput

ROWS = ["0.01,5,1", "0.02,9,1", "0.03,10,1", "0.01,6,100", "0.02,11,100", "0.03,12,100"]


def test_a_curve_for_each_rate_in_si_by_the_units_given_and_bad_tables_are_named(tmp_path):
    def table(header, rows=ROWS):
        path = tmp_path / "curves.csv"
        path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
        return path

    slow, fast = read(table("Strain [%], stress (MPa), rate (1/s)"))
    assert (slow.rate, fast.rate) == (1, 100)
    np.testing.assert_allclose(slow.strain, [1e-4, 2e-4, 3e-4])
    np.testing.assert_allclose(fast.stress, [6e6, 11e6, 12e6])
    assert read(table("strain,stress (MPa),rate"), {"stress": "Pa"})[0].stress[0] == 5e6
    for header, rows, words in (
        ("strain,force,rate", ROWS, "no column stress"),
        ("strain,stress,rate", ROWS, "column stress: has no unit"),
        ("strain,stress (Pa),rate", [*ROWS, "1.5,12,1"], "line 8: strain = 1.5, must be from 0 to 1 1"),
        ("strain,stress (Pa),rate", ["0.01,-5,1"] * 5, "stress: is negative"),
        ("strain,stress (Pa)", [f"{0.5 - 0.1 * n},{5 - n}" for n in range(5)], "begins at its largest"),
        ("strain,stress (Pa),rate", [f"0.{n},{n},1.{n}" for n in range(1, 7)], "the rate 1.1 1/s has 1 rows"),
        ("test,stress (Pa),rate,strain", ["a,1,1,1"] * 4 + ["a,1,2,1"], "test a has 2 rates"),
    ):
        with pytest.raises(BadInput) as refused:
            read(table(header, rows))
        assert words in str(refused.value)


TRUTH = {"E": 900e6, "K": 60e6, "yield_stress": 8e6, "overstress": 3e6, "exponent": 0.2}


def curves(rates, seed=None, highest=0.06, n=30, **changed):
    """Draw curves of the parameters `TRUTH`, with noise if there is a seed."""
    values = [*(TRUTH | changed).values()][: 3 if len(rates) == 1 else 5]
    noise = np.random.default_rng(seed).normal(0, 0.2e6 if seed is not None else 0, (len(rates), n))
    strain = np.linspace(highest / n, highest, n)
    bare = zip((Curve(rate, strain, strain) for rate in rates), noise, strict=True)
    return [curve._replace(stress=stress(values, curve) + error) for curve, error in bare]


def test_the_stress_is_that_of_the_law_step_by_step_with_unloading():
    path = np.array([0.002, 0.01, 0.03, 0.028, 0.025, 0.029, 0.04])
    coating = Coating(900e6, 60e6, 0.0, 8e6, modulus_unit=1.0, thickness=1.0, n_elements=1)
    expected, wear = [], 0.0
    for strain in path:
        force, wear = law.load(coating, strain, wear)
        expected.append(float(force))
    np.testing.assert_allclose(stress([900e6, 60e6, 8e6], Curve(0.0, path, path)), expected, rtol=1e-12)


def test_parameters_come_back_from_exact_curves_and_elastic_ones_give_no_hardening():
    for rates in ([0.0], [1e-3, 0.1, 1, 100]):
        for parameter in fit(curves(rates)).parameters:
            assert parameter.value == pytest.approx(TRUTH[parameter.name], rel=1e-5)
    found = fit(curves([0.0, 2.0], exponent=1.0))
    assert [parameter.name for parameter in found.parameters][3:] == ["overstress"]
    assert found["overstress"].value == pytest.approx(3e6, rel=1e-5)
    elastic = fit(curves([0.0], seed=1, highest=0.005))
    assert elastic["E"].determined
    assert (elastic["K"].determined, elastic["K"].standard_error) == (False, None)


def test_the_overstress_at_two_rates_is_the_viscosity_of_the_viscoplastic_law():
    E, K, limit, viscosity = 900e6, 450e6, 9e6, 2e3
    strain, decay = np.linspace(0.0005, 0.04, 80), (E + K) / viscosity

    def flowing(rate):  # the exact solution at a constant rate
        time = np.maximum(strain - limit / E, 0) / rate
        plastic = E * rate / (E + K) * (time - (1 - np.exp(-decay * time)) / decay)
        return Curve(rate, strain, E * (strain - plastic))

    assert fit([flowing(1e-3), flowing(1e3)])["overstress"].value == pytest.approx(viscosity, rel=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("rates", [[0.0], pytest.param([1e-3, 0.1, 1, 100], marks=pytest.mark.nightly)])
def test_intervals_cover_the_truth_as_often_as_they_say(rates):
    draws = [fit(curves(rates, seed)) for seed in range(200)]
    for name in [parameter.name for parameter in draws[0].parameters]:
        covered = np.mean([found[name].low <= TRUTH[name] <= found[name].high for found in draws])
        assert 0.90 <= covered <= 0.99  # binomial: 0.95 within three standard deviations of 200 draws
