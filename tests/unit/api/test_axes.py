import matplotlib.pyplot as plt
import numpy as np
import pytest
import yaml
from matplotlib.figure import Figure

import bladerub as br


@pytest.fixture
def axes():
    return Figure().add_subplot()


@pytest.fixture(scope="module")
def stiffer(study, blade):
    return br.simulate(blade, study.run("2nd", E=11, K=0.5, f_omega=0.19, revolutions=3), follow=False)


def test_each_run_is_a_line_in_the_axes(run, stiffer, axes):
    for each in (run, stiffer):
        assert each.plot_spectrum(ax=axes) is axes
    for line, each in zip(axes.lines, (run, stiffer), strict=True):
        np.testing.assert_array_equal(line.get_data(), [each.spectrum.index, 1e3 * each.spectrum])
    assert axes.get_ylim()[1] > 1e3 * max(run.spectrum.max(), stiffer.spectrum.max())
    assert len({(line.get_color(), line.get_linestyle()) for line in axes.lines}) == 2


def test_wear_is_drawn_around_polar_axes_and_along_others(run, stiffer, axes):
    polar = plt.figure().add_subplot(projection="polar")
    for each in (run, stiffer):
        assert each.plot_wear(ax=polar) is polar
        assert each.plot_wear(ax=axes) is axes
    for drawn, angle in ((polar, run.angle), (axes, np.degrees(run.angle))):
        line = drawn.lines[1]
        np.testing.assert_allclose(line.get_xdata()[: angle.size], angle)
        np.testing.assert_array_equal(line.get_ydata()[: angle.size], 1e3 * stiffer.wear.mean(axis=0))
    plt.close(polar.figure)


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
