import doctest
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from matplotlib.figure import Figure

import bladerub as br
from bladerub.blade.cache import first_frequency
from bladerub.study.job import compute_missing
from bladerub.study.plan import CoatingPlan, planned_run

NAMES = [name for name in dir(br) if name != "__version__"]


@pytest.mark.extras
def test_every_public_name_is_on_the_page_of_the_interface():
    page = (Path(__file__).parents[3] / "docs" / "reference" / "api.md").read_text(encoding="utf-8")
    documented = re.findall(r"^\.\. auto(?:function|class|exception):: (\w+)$", page, re.M)
    assert sorted(documented) == sorted(NAMES)


@pytest.mark.extras
@pytest.mark.parametrize("name", NAMES)
def test_examples_of_a_public_name_run(name, study, blade, run, sweep, small, tmp_path, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    monkeypatch.chdir(tmp_path)
    names = {"br": br, "study": study, "blade": blade, "run": run, "sweep": sweep}
    examples = doctest.DocTestFinder().find(getattr(br, name), name, globs=names)
    runner = doctest.DocTestRunner()
    for example in examples:
        runner.run(example)
    tried, failed = runner.summarize(verbose=False).attempted, runner.failures
    assert tried > 0
    assert failed == 0


def test_bad_argument_is_named_with_value_and_what_is_right(study):
    for arguments, name in (
        ({"casing": "2dn"}, "casing"),
        ({"friction": 0.1, "theta": 0.1}, "friction"),
        ({"revolutions": 2.5}, "revolutions"),
    ):
        given = {"casing": "2nd", "E": 2, "K": 0.5, "f_omega": 0.19} | arguments
        with pytest.raises(br.InputError) as caught:
            study.run(given.pop("casing"), **given)
        assert caught.value.name == name
        assert str(caught.value) == f"{name} = {caught.value.value}: {caught.value.right}"
    for settings in (None, 5, [1]):
        with pytest.raises(br.InputError, match="settings = "):
            br.Study.from_settings(settings)


def test_a_wrong_value_is_named_with_its_place_and_a_replaced_one_is_another_study(tmp_path, study):
    path = tmp_path / "bad.yaml"
    path.write_text("\nblade:\n  length: -1\n")
    with pytest.raises(br.ConfigError) as caught:
        br.load_study(path)
    assert str(caught.value).startswith(f"{path}:3: blade.length = -1")
    damped = study.replace("contact.damping_ratio", 1e-3)
    assert damped.config.contact.damping_ratio == 1e-3
    assert damped == study.replace({"contact": {"damping_ratio": 1e-3}}) != study
    with pytest.raises(br.ConfigError, match=r"contact\.damping_ratio = 2"):
        study.replace("contact.damping_ratio", 2)


def test_a_config_is_found_in_the_working_directory_or_the_package(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert br.load_study("config/quick.yaml").config.blade.mesh.thickness == 1
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "quick.yaml").write_text("solver: {revolutions: 30}\n")
    assert br.load_study("config/quick.yaml").config.solver.revolutions == 30


def test_a_run_in_units_is_that_in_plain_numbers(study):
    own = {"damping_ratio": "0.4 %", "layer_thickness": "4 mm"}
    typed = study.run("2nd", E="1.2 GPa", K="300MPa", f_omega="2200 rpm", **own)
    f_omega = round(2200 / 60 / first_frequency(study.config), 6)
    own = {"damping_ratio": 0.004, "layer_thickness": 0.004}
    assert typed == study.run("2nd", E=2, K=0.5, f_omega=f_omega, **own)


def test_blade_is_built_once_and_goes_to_xarray_and_pandas(study, blade, small, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    written = blade.path.stat().st_mtime_ns
    assert br.build_blade(study).path == blade.path
    assert blade.path.stat().st_mtime_ns == written
    with xr.open_dataset(blade.path, engine="h5netcdf", phony_dims="sort") as opened:
        xr.testing.assert_identical(blade.to_xarray(), opened.load())
    assert {"f_omega", "mode", "f_fe", "f_rom"} <= set(blade.accuracy().columns)
    single = [blade.frequencies(speed, 2) for speed in (0.0, 0.2)]
    np.testing.assert_array_equal(blade.frequencies([0.0, 0.2], 2), single)


@pytest.mark.extras
def test_a_doubtful_blade_gets_a_warning(study, blade, small, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    fast = study.config.replaced("figures.nominal_speed", 6e4)
    with pytest.warns(UserWarning, match="beyond reduction.f_omega_max = 0.4"):
        br.build_blade(br.Study(fast, study.folder))


@pytest.mark.extras
def test_speeds_ascend_and_are_the_single_runs_whatever_the_jobs(study, blade, sweep):
    coating = study.coating("2nd", E=2, K=0.5)
    again = br.simulate_speeds(blade, coating, [0.19, 0.2], jobs=2, progress=False)
    xr.testing.assert_identical(again.to_xarray(), sweep.to_xarray())
    assert sweep.f_omega.tolist() == [0.19, 0.2]
    single = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19), follow=False)
    np.testing.assert_array_equal(sweep.wear[0], single.wear.mean(axis=0))
    for speeds in ([0.2], [0.2, 0.2], [0.2, 0.45]):
        with pytest.raises(br.InputError) as caught:
            br.simulate_speeds(blade, coating, speeds, progress=False)
        assert caught.value.name == "speeds"


@pytest.mark.extras
def test_each_counts_the_revolutions_and_a_speed_of_no_such_blade_is_named(study, blade):
    done = []
    asked = study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=2)
    run = br.simulate(blade, asked, follow=False, progress=True, each=done.append)
    assert done == [1, 2]
    of_other_blade = study.replace("blade.length", 0.25).run("2nd", E=2, K=0.5, f_omega="2200 rpm")
    for refused in (study.run("2nd", E=2, K=0.5, f_omega=0.45), of_other_blade):
        with pytest.raises(br.InputError) as caught:
            br.simulate(blade, refused)
        assert caught.value.name == "f_omega"
    for n_modes in (0, -1, 2.5, 10**6):
        with pytest.raises(br.InputError, match="n_modes = "):
            blade.frequencies(0.1, n_modes)
    with pytest.raises(br.InputError, match="row = 5"):
        br.simulate(blade, asked, row=5)
    with pytest.raises(br.InputError, match="config = "):
        run.summary(study)


def test_growing_run_is_followed_further(study, blade):
    asked, settings = study.run("2nd", E=2, K=0.5, f_omega=0.196), study.config.analysis.divergence
    run, short = br.simulate(blade, asked), br.simulate(blade, asked, follow=False)
    assert short.longer is None
    assert run.longer.revolutions == settings.confirmation_revolutions
    assert run.verdict().revolutions == run.longer.revolutions > short.verdict().revolutions


@pytest.mark.extras
def test_the_run_with_its_stress_is_the_run(study, blade):
    asked = study.run("2nd", E=2, K=0.5, f_omega=0.19)
    run, stressed = (br.simulate(blade, asked, stress=stress) for stress in (False, True))
    assert run.stress is None
    assert stressed.attributes["stress_last_von_mises"] == stressed.stress.last["von_mises"]
    for name in ("wear", "radial_displacement", "revolution_peak", "spectrum_amplitude"):
        np.testing.assert_array_equal(stressed.stored.data[name], run.stored.data[name])


@pytest.mark.extras
def test_a_row_tells_of_each_blade(study, blade):
    row = br.Row.even(3, length=[0.0, 5e-5, -4e-3], frequency=[0.0, 0.01, 0.0])
    row_run = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=3), row=row)
    blades = row_run.blades
    assert blades.length.to_dict() == {1: 0.0, 2: 5e-5, 3: -4e-3}
    np.testing.assert_allclose(blades.frequency, [0.0, 0.01, 0.0], atol=1e-15)
    assert blades.worn_volume[3] == blades.peak[3] == 0
    assert blades.amplitude.idxmax() == row_run.attributes["blade"]
    assert row_run.revolution_amplitude.max() == blades.amplitude.max()
    assert row_run.energy.wear > 0
    assert row_run.attributes["energy_residual"] < 1e-3
    assert row_run.to_xarray()["blade_worn_volume"].dims == ("blade",)


@pytest.mark.extras
def test_rows_are_computed_once_and_again_when_their_blades_change(study, blade, tmp_path):
    planned = study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=3).of_length(blade.length)

    def made(row):
        lines = []
        coating = CoatingPlan(planned.case, (planned_run(planned.config, planned.spec, "0.h5", False, row),))
        compute_missing(planned.config, coating, blade.reduced, tmp_path, blade.digest, lines.append)
        return len(lines)

    row, other = (br.Row.drawn(2, 0, length_scatter=scatter) for scatter in (2e-5, 4e-5))
    assert made(row) == 1
    first = br.read_run(tmp_path / "0.h5")
    assert [made(each) for each in (row, other, row)] == [0, 1, 0]  # back from the archive
    pd.testing.assert_frame_equal(br.read_run(tmp_path / "0.h5").blades, first.blades)


@pytest.fixture(scope="module")
def stiffer(study, blade):
    return br.simulate(blade, study.run("2nd", E=11, K=0.5, f_omega=0.19, revolutions=3), follow=False)


def test_runs_are_lines_in_the_axes_wear_around_polar_ones(run, stiffer):
    polar, axes, spectra = (Figure().add_subplot(projection=of) for of in ("polar", None, None))
    for each in (run, stiffer):
        assert each.plot_wear(ax=polar) is polar
        assert each.plot_wear(ax=axes) is axes
        assert each.plot_spectrum(ax=spectra) is spectra
    for line, each in zip(spectra.lines, (run, stiffer), strict=True):
        np.testing.assert_array_equal(line.get_data(), [each.spectrum.index, 1e3 * each.spectrum])
    for drawn, angle in ((polar, run.angle), (axes, np.degrees(run.angle))):
        line = drawn.lines[1]
        np.testing.assert_allclose(line.get_xdata()[: angle.size], angle)
        np.testing.assert_array_equal(line.get_ydata()[: angle.size], 1e3 * stiffer.wear.mean(axis=0))


@pytest.mark.extras
def test_histories_maps_and_the_blade_are_drawn_into_the_axes(run, sweep, blade):
    history, wear, spectra, campbell, mesh = (Figure().add_subplot() for _ in range(5))
    assert run.plot_history(ax=history) is history
    displacement, amplitude = history.lines
    np.testing.assert_array_equal(displacement.get_ydata(), 1e3 * run.radial_displacement)
    np.testing.assert_array_equal(amplitude.get_ydata(), 1e3 * run.revolution_amplitude)
    assert sweep.plot_wear(ax=wear) is wear
    np.testing.assert_array_equal(wear.collections[0].get_array(), 1e3 * sweep.wear.T)
    assert sweep.plot_spectrum(ax=spectra) is spectra
    expected = 1e3 * sweep.coating.spectrum_amplitude
    np.testing.assert_array_equal(spectra.collections[0].get_array(), expected)
    assert blade.plot_campbell(ax=campbell) is campbell
    first = blade.accuracy().query("mode == 1").f_rom / blade.f1_hz
    assert any(np.array_equal(line.get_ydata(), first) for line in campbell.lines)
    assert blade.plot_mesh(ax=mesh) is mesh
    assert len(mesh.collections[0].get_paths()) > 50


def test_lists_give_lists_over_their_combinations(study, blade):
    runs = study.run("2nd", E=[1, 2], K=0.5, f_omega=np.array([0.19, 0.2]), revolutions=2)
    assert [(run.case.E, run.f_omega) for run in runs] == [(1, 0.19), (1, 0.2), (2, 0.19), (2, 0.2)]
    assert study.coating("2nd", E=2, K=0.5).at(["2200 rpm", 0.2])[1].f_omega == 0.2
    solved = br.simulate(blade, runs[::2], follow=False)
    assert [run.case.E for run in solved] == [1, 2]
    assert solved[0] == br.simulate(blade, runs[0], follow=False)


@pytest.mark.extras
def test_a_table_of_speeds_says_what_the_runs_do(study, blade, sweep):
    table = sweep.to_pandas()
    for f_omega, row in table.iterrows():
        run = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=f_omega))
        summary = run.summary()
        assert row.rpm == pytest.approx(60 * f_omega * blade.f1_hz)
        for name in ("engine_order", "max_wear", "growth_per_revolution", "status"):
            assert row[name] == summary[name]
        found = [word for word in ("divergent", "saturating") if summary[word]] or ["bounded"]
        assert [row.verdict] == found
        assert row.revolution_amplitude == run.revolution_amplitude[-1]


def test_settings_make_the_study_that_their_file_makes(study, small):
    settings = yaml.safe_load((small / "small.yaml").read_text())
    assert br.Study.from_settings(settings) == study
    assert br.Study.from_settings(study.config.plain()) == study
    with pytest.raises(br.ConfigError, match="chordwize"):
        br.Study.from_settings({"blade": {"mesh": {"chordwize": 7}}})
