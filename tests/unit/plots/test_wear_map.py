from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from bladerub.plots import bins, engine_orders
from bladerub.plots.campbell import campbell
from bladerub.plots.polar import casing_polar, wear_profiles
from bladerub.plots.scales import Engine, Scales
from bladerub.plots.spectrum import ORDERS, PeakSection, peak_sections, spectrum_map
from bladerub.plots.wear_map import wear_map
from bladerub.study.grid import CoatingCase
from bladerub.study.peaks import Peak


def test_depth_over_speed_and_angle(coating_map, draws):
    upper, lower, _ = draws(wear_map(coating_map)).axes
    mesh = upper.collections[0]
    np.testing.assert_allclose(mesh.get_array().reshape(40, 6), 1e3 * coating_map.wear.T)
    assert mesh.norm.vmin == 0
    assert upper.get_ylim() == (0, 360)
    np.testing.assert_allclose(mesh.get_coordinates()[:, 0, 1], np.arange(41) * 9.0, atol=1e-9)  # degrees
    assert lower.get_xlim() == pytest.approx((0, 0.375))
    assert lower.get_ylim()[0] == 0


def test_runs_that_ended_early_are_crossed(coating_map, draws):
    lower = draws(wear_map(coating_map)).axes[1]
    completed, early = lower.lines
    np.testing.assert_array_equal(completed.get_ydata(), [5, 5, 10, 5, 5])
    np.testing.assert_array_equal(early.get_xydata(), [[0.35, 4]])
    assert early.get_marker() == "x"


def test_speeds_that_were_not_run_stay_empty(coating_map, draws):
    speeds = np.array([0.1, 0.12, 0.14, 0.3, 0.32, 0.34])
    mesh = draws(wear_map(replace(coating_map, f_omega=speeds))).axes[0].collections[0]
    columns = mesh.get_array().reshape(40, 7).mask.all(axis=0)
    np.testing.assert_array_equal(columns, [False, False, False, True, False, False, False])
    edges = mesh.get_coordinates()[0, :, 0]
    np.testing.assert_allclose(edges, [0.09, 0.11, 0.13, 0.16, 0.28, 0.31, 0.33, 0.35])


RANGE = (5e-7, 5e-4)


NO_BAND = (np.nan, np.nan)


@pytest.fixture
def axes(coating_map, draws):
    return draws(spectrum_map(coating_map, RANGE, f_max=2.5)).axes


def test_colours_are_the_amplitudes_in_mm_on_the_given_scale(axes, coating_map):
    mesh = axes[0].collections[0]
    drawn = mesh.get_array().reshape(6, -1)
    np.testing.assert_allclose(drawn[4], 1e3 * coating_map.spectrum_amplitude[4])
    assert (mesh.norm.vmin, mesh.norm.vmax) == pytest.approx((5e-4, 0.5))


def test_each_bin_lies_on_its_frequency(axes, coating_map):
    corners = axes[0].collections[0].get_coordinates()
    centres = (corners[1:, 1:] + corners[:-1, :-1]) / 2
    speed, order = 4, 8  # f_Ω = 0.3, eo(4)
    assert corners[speed, order, 0] < 4 * 0.3 < corners[speed + 1, order + 1, 0]
    assert centres[speed, order, 1] == pytest.approx(coating_map.f_omega[speed])


def test_c1_is_the_frequency_of_the_blade(axes, coating_map):
    (c1,) = [line for line in axes[0].lines if line.get_label() == "$C_1$"]
    np.testing.assert_array_equal(c1.get_xdata(), coating_map.C1)
    np.testing.assert_array_equal(c1.get_ydata(), coating_map.f_omega)
    assert c1.is_dashed()
    assert len(axes[0].lines) == len(ORDERS) + 1


@pytest.fixture
def sections(coating_map):
    on_order = coating_map.spectrum_amplitude[:, 8]
    return [
        PeakSection(4, on_order, (0.25, 0.36), Peak(0.3, on_order[4]), (0.29, 0.31), (1e-5, 2e-5)),
        PeakSection(
            6, coating_map.spectrum_amplitude[:, 12], (0.16, 0.24), Peak(0.2, 1e-6), NO_BAND, NO_BAND
        ),
    ]


@pytest.fixture
def peak_axes(coating_map, sections, draws):
    return draws(peak_sections(coating_map, sections, RANGE, f_max=2.5)).axes


def test_a_peak_with_an_ensemble_has_error_bars(peak_axes):
    bars = {line.get_label(): [] for line in peak_axes[1].lines if line.get_label().startswith("_band")}
    for line in peak_axes[1].lines:
        if line.get_label() in bars:
            bars[line.get_label()].append(np.transpose(line.get_data()).tolist())
    (across, along) = bars.pop("_band4")
    assert not bars
    np.testing.assert_allclose(across, [[0.01, 0.3], [0.02, 0.3]])
    assert [f for _, f in along] == [0.29, 0.31]


def test_curves_are_the_amplitudes_in_mm(peak_axes, sections):
    curves = [line for line in peak_axes[1].lines if line.get_label().startswith("eo(")]
    assert len(curves) == 2
    for curve, section in zip(curves, sections, strict=True):
        np.testing.assert_allclose(curve.get_xdata(), 1e3 * section.amplitude)
    assert peak_axes[1].get_xlim() == pytest.approx((0, 1.1 * 0.101))


ANGLE = np.linspace(0, 2 * np.pi, 60, endpoint=False)


def test_casing_is_magnified_inward(draws):
    inward = {"2": 1e-3 * np.cos(2 * ANGLE), "5": 1e-3 * np.cos(5 * ANGLE)}
    (axes,) = draws(casing_polar(ANGLE, inward, radius=0.65, magnification=100)).axes
    circle, two, five = axes.lines
    np.testing.assert_allclose(circle.get_ydata(), 0.65)
    np.testing.assert_allclose(two.get_ydata()[:-1], 0.65 - 0.1 * np.cos(2 * ANGLE))
    np.testing.assert_allclose(five.get_ydata()[:-1], 0.65 - 0.1 * np.cos(5 * ANGLE))
    for line in axes.lines:  # closed
        angle, radius = line.get_data()
        assert angle[-1] - angle[0] == pytest.approx(2 * np.pi)
        assert radius[-1] == radius[0]


def test_wear_is_that_of_the_speeds_asked_for(coating_map, draws):
    straight = replace(coating_map, case=CoatingCase("2nd", 2.0, 0.5, 0.0), wear=2 * coating_map.wear)
    table, figure = wear_profiles([straight, coating_map], [0.15, 0.3])
    assert list(table.columns) == ["f_omega", "theta", "angle", "wear"]
    for theta, coating in ((0.0, straight), (0.15, coating_map)):
        rows = table[(table.f_omega == 0.3) & (table.theta == theta)]
        np.testing.assert_array_equal(rows[["angle", "wear"]], np.transpose([coating.angle, coating.wear[4]]))
    first, second = draws(figure).axes
    assert len(first.lines) == len(second.lines)
    np.testing.assert_allclose(second.lines[0].get_ydata()[:-1], 1e3 * straight.wear[4])


SPEED = np.linspace(0, 0.4, 5)


FE = np.sqrt(np.array([1, 9, 25])[None] + 4 * SPEED[:, None] ** 2)


ROM = 1.01 * FE


@pytest.fixture
def panels(draws):
    return draws(campbell(SPEED, FE, ROM, range(1, 13))).axes


def test_both_models_in_both_panels(panels):
    for panel in panels:
        rom = [line for line in panel.lines if line.get_label() in ("reduced model", "_rom")]
        fe = [line for line in panel.lines if line.get_label() in ("finite elements", "_fe")]
        np.testing.assert_array_equal(np.transpose([line.get_ydata() for line in rom]), ROM)
        np.testing.assert_array_equal(np.transpose([line.get_ydata() for line in fe]), FE)
        assert all(line.is_dashed() for line in fe)
        assert not any(line.is_dashed() for line in rom)


@pytest.mark.parametrize("over", ["speed", "frequency"])
def test_lines_have_slope_k_and_end_at_the_frame(over):
    axes = Figure().add_subplot()
    if over == "speed":
        engine_orders.draw(axes, {k: k for k in range(1, 9)}, 0.4, 2.0)
        lines = [line.get_xydata() for line in axes.lines]
    else:
        engine_orders.draw(axes, {k: 1 / k for k in range(1, 9)}, 2.0, 0.4)
        lines = [line.get_xydata()[:, ::-1] for line in axes.lines]
    for k, line in enumerate(lines, start=1):
        (x0, y0), (speed, f) = line
        assert (x0, y0) == (0, 0)
        assert f == pytest.approx(k * speed)
        assert speed == pytest.approx(0.4) or f == pytest.approx(2.0)
    assert [text.get_text() for text in axes.texts][:4] == ["eo(1)", "eo(2)", "eo(3)", "eo(4)"]


ENGINE = Engine(f1_hz=850.0, nominal_speed=15300.0)  # f_omega = 0.3


SCALES = Scales(modulus_unit=0.6e9, length=0.066, engine=ENGINE)


def second(axes, along):
    """Limits, name and numbers of the second scale along "x" or "y"."""
    axes.figure.canvas.draw()
    (found,) = [child for child in axes.child_axes if getattr(child, f"get_{along}label")()]
    ends = getattr(found, f"get_{along}lim")()
    ticks = [text.get_text() for text in getattr(found, f"get_{along}ticklabels")()]
    return ends, getattr(found, f"get_{along}label")(), ticks


def nominal(axes):
    """Where the lines of the nominal speed are, by their label."""
    return {line.get_label(): line.get_xydata()[0] for line in axes.lines if "nominal" in line.get_label()}


def test_a_wear_map_has_the_speed_of_the_rotor_from_the_first_of_the_study_on(coating_map, draws):
    upper, lower, _ = draws(wear_map(coating_map, SCALES)).axes
    assert lower.get_xlim() == pytest.approx((0.075, 0.375))
    ends, name, ticks = second(lower, "x")
    assert ends == pytest.approx(60 * 850 * np.array([0.075, 0.375]))
    assert name == "rotor speed (rpm, Hz)"
    assert "12000\n200 Hz" in ticks
    assert nominal(upper)["nominal speed, 15300 rpm"][0] == pytest.approx(0.3)
    assert nominal(lower)["_nominal"][0] == pytest.approx(0.3)


def test_a_campbell_diagram_has_both(draws):
    speed = np.linspace(0, 0.4, 5)
    modes = np.sqrt(np.array([1, 9, 25])[None] + 4 * speed[:, None] ** 2)
    for axes in draws(campbell(speed, modes, modes, range(1, 13), ENGINE)).axes:
        assert second(axes, "x")[0] == pytest.approx((0, 20400))
        assert second(axes, "y")[0] == pytest.approx(850 * np.array(axes.get_ylim()))
        assert nominal(axes)["nominal speed, 15300 rpm"][0] == pytest.approx(0.3)


def test_edges_lie_half_way():
    np.testing.assert_allclose(bins.edges([0.1, 0.2, 0.4]), [0.05, 0.15, 0.3, 0.5])


def test_an_extra_speed_opens_no_gap():
    speed_edges, rows = bins.with_gaps([0.18, 0.19, 0.197, 0.2], np.eye(4))
    np.testing.assert_allclose(speed_edges, [0.175, 0.185, 0.1935, 0.1985, 0.2015])
    np.testing.assert_array_equal(rows, np.eye(4))


def test_missing_speeds_stay_a_gap():
    speed_edges, rows = bins.with_gaps([0.1, 0.11, 0.12, 0.3, 0.31], np.arange(5.0)[:, None])
    np.testing.assert_allclose(speed_edges, [0.095, 0.105, 0.115, 0.13, 0.29, 0.305, 0.315])
    np.testing.assert_array_equal(rows[:, 0], [0, 1, 2, np.nan, 3, 4])
