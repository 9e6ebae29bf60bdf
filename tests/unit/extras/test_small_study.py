from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from study_fixtures import changed

from bladerub import plugins
from bladerub.blade.frequencies import accuracy_table, reduced_frequencies
from bladerub.extras import blade_comparison, heat, small_study
from bladerub.extras.friction import table as friction
from bladerub.extras.friction.coatings import compared
from bladerub.io.folders import ROOT
from bladerub.io.tables import described_columns
from bladerub.study import grid
from bladerub.study.grid import coating_cases
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.study.maps import DATASETS


def test_a_small_study_has_all_runs_judges_the_claims_asked_for_and_is_the_same_without_a_folder(
    study, blade, simulated, growing, repeated, monkeypatch, tmp_path
):
    coatings = [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.15]}]
    study = changed(study, coatings=coatings, analysis={"histories": [], "peaks": {"orders": [4, 6]}})
    monkeypatch.setattr(small_study, "read_reduced_blade", lambda _: blade)
    monkeypatch.setattr(small_study, "blade_digest", lambda _: "blade")
    accuracy = pd.DataFrame({"f_omega": 0.1, "mode": range(1, 8), "relative_error": 1e-3})
    monkeypatch.setattr(small_study, "read_rom_accuracy", lambda _: accuracy)

    def made(claims=None, folder=tmp_path / "study"):
        return small_study.conduct(study, "model.h5", "rom_accuracy.csv", folder, claims)

    growing[0.19] = 0.05
    found = made({"C1"})
    assert (simulated, repeated, found.n_runs) == ([0.1, 0.19, 0.2, 0.3], [0.19], 5)
    assert list(found.divergence.f_omega) == [0.1, 0.19, 0.2, 0.3]
    assert set(found.findings["id"]) == {"C1a", "C1b"}
    simulated.clear()
    assert made({"C2"}).findings.empty
    assert simulated == []
    kept = made()
    files = sorted(tmp_path.rglob("*"))
    passing = made(folder=None)
    assert sorted(tmp_path.rglob("*")) == files
    assert passing.n_runs == kept.n_runs == 5
    for table in ("peaks", "divergence", "findings"):
        pd.testing.assert_frame_equal(getattr(passing, table), getattr(kept, table), check_exact=True)
    (case,) = coating_cases(study)
    in_memory, of_files = passing.evidence.map(case), kept.evidence.map(case)
    for name in DATASETS.keys() - {"wear_node"}:
        assert getattr(in_memory, name).dtype == getattr(of_files, name).dtype
        np.testing.assert_array_equal(getattr(in_memory, name), getattr(of_files, name))


def test_both_laws_are_compared_speed_by_speed_for_coatings_that_are_no_part_of_the_study(
    write_run, make_result, spec, config, tmp_path
):
    def stored(law, speeds, amplitude=1e-3, **changes):
        result = replace(make_result(amplitude=amplitude), **changes)
        rows = []
        for f_omega in speeds:
            path = write_run(f"{law}/{f_omega:.4f}.h5", result=result, spec=replace(spec, f_omega=f_omega))
            rows.append(ManifestRow(path.name, f_omega, "key", result.status, 1, "sum"))
        write_manifest(tmp_path / law / "manifest.tsv", rows)
        return tmp_path / law / "manifest.tsv"

    constant = stored("theta", [0.1, 0.2], n_reversed_steps=30, slowest_sliding=-0.2)
    coulomb = stored("coulomb", [0.1, 0.2], amplitude=1.1e-3, n_reversed_steps=60, status="unbounded")
    table = friction.table([(constant, coulomb)], revolutions=10)
    described = {*friction.COLUMNS, *blade_comparison.BLADE_COLUMNS, *blade_comparison.RUN_COLUMNS}
    files = [*plugins.files("columns.csv"), ROOT / "studies" / "blade_comparison" / "columns.csv"]
    assert described <= described_columns(*files).keys()
    assert list(table.f_omega) == [0.1, 0.2]
    first = table.iloc[0]
    assert (first.peak_theta, first.peak_coulomb) == pytest.approx((1e-3, 1.1e-3), rel=1e-4)
    assert first.difference == pytest.approx(0.1)
    assert (first.reversed_theta, first.reversed_coulomb) == pytest.approx((0.1, 0.2))
    assert first.slowest_sliding == -0.2
    assert (first.status_theta, first.status_coulomb) == ("completed", "unbounded")
    config = changed(config, friction=[{"casing": "2nd", "E": [3], "K": [0.5], "theta": [0.15, 0.3]}])
    cases = compared(config)
    assert [case.name for case in cases[:2]] == ["2nd_E3_K0.5_theta0.15", "2nd_E3_K0.5_mu0.151135"]
    assert [grid.case_from_name(config, case.name) for case in cases] == cases
    assert not set(cases) & set(grid.coating_cases(config))


def test_the_figures_of_a_blade_are_those_of_its_model_and_its_compliance_that_of_springs(blade):
    """Of a blade that the rotation moves by 0.1 mm and whose model is off by a part for each mode."""
    coupled = blade.stiffness_0 + 0.1 * blade.stiffness_0[0, 0]
    reduced = replace(blade, stiffness_0=coupled, stiffness_1=3 * coupled)
    exact = {speed: reduced_frequencies(reduced, speed, 7) for speed in (0.0, 0.2, 0.4)}
    off = 1 + 1e-3 * np.arange(1, 8)
    accuracy = accuracy_table(reduced, {s: f / off for s, f in exact.items()}, exact)
    moved = np.zeros((3, 5, 3))
    moved[-1, 2] = (0.6e-4, 0.0, 0.8e-4)
    built = SimpleNamespace(reduced=reduced, accuracy=accuracy, static_displacement=moved)
    table = blade_comparison.blades({"this": built, "reference": built})
    figures = table[table.blade == "this"].set_index("number").value
    f1, f2 = reduced_frequencies(reduced, 0.0, 2)
    expected = {"f1": f1 / 1.001, "f2_over_f1": f2 / f1 * 1.001 / 1.002, "stiffening": np.sqrt(1.48)}
    expected |= {"error_modes_1_to_6": 6e-3, "error_mode_7": 7e-3, "error_eq2": 7e-3, "coordinates": 24}
    expected["centrifugal_displacement"] = 1e-4
    assert figures[list(expected)].to_dict() == pytest.approx(expected)
    assert (table.value[table.blade == "reference"].to_numpy() == figures.to_numpy()).all()
    springs = np.diag(np.repeat(np.arange(1.0, 9.0), 3)) * 1e6  # the same in all directions of a node
    expected = np.mean(1 / (8 * np.arange(1.0, 9.0) * 1e6))
    measured = blade_comparison.radial_compliance(replace(blade, stiffness_0=springs))
    assert measured == pytest.approx(expected, rel=1e-12)


def test_runs_are_compared_at_the_common_speeds(config, case, make_map):
    one = make_map(case, {4: (0.3, 1e-3)}, f_omega=[0.1, 0.25, 0.3], lobes=[2, 4, 5], growth=[0.0, 0.0, 0.1])
    other = make_map(case, {4: (0.3, 1e-3)}, f_omega=[0.1 + 1e-13, 0.2, 0.3], lobes=[2, 3, 4])
    table = blade_comparison.runs(config, [(one, other)], (0.1, 0.2))
    both = [[0.1, 2, 2, False, False], [0.3, 5, 4, True, False]]
    columns = ["f_omega", "lobes", "reference_lobes", "divergent", "reference_divergent"]
    assert table[columns].to_numpy().tolist() == both
    shares = table[["worn_depth_share", "reference_worn_depth_share"]].to_numpy()
    np.testing.assert_allclose(shares, 2 * [[1e-4 / 0.1, 1e-4 / 0.2]], rtol=1e-5)
    assert (table.casing == case.casing).all()


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
    cases = list(zip(table.theta, table.conductivity.fillna(0), strict=True))
    assert cases == [(theta, values[0] if values else 0) for theta, values in heat.CASES]
    cold = table.conductivity.isna()
    assert (table.max_temperature_rise.fillna(0) == np.where(cold, 0, 100)).all()
    longest = config.analysis.divergence.confirmation_revolutions
    assert (table.revolutions == np.where(table.theta > 0, longest, config.solver.revolutions)).all()
    assert (table.divergent == (table.theta > 0)).all()
    warm = table.growth_per_revolution[(table.theta > 0) & ~cold]
    np.testing.assert_allclose(warm, np.expm1(0.05), rtol=1e-6)
    assert {spec.f_omega for spec in specs} == {heat.F_OMEGA}
