import math
from dataclasses import replace

import matplotlib
import numpy as np
import pandas as pd
import pytest
from mpl_toolkits.mplot3d import Axes3D

from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.surface import boundary_faces, normals
from bladerub.contact.illustration import pressed_elements
from bladerub.contact.spec import Coating, TipProfile
from bladerub.plots import maps, style
from bladerub.plots.blade_mesh import front_faces, project
from bladerub.plots.campbell import campbell
from bladerub.plots.histogram import peak_histogram
from bladerub.plots.illustration import tip_profile
from bladerub.plots.maps import peak_sections, spectrum_map, wear_map
from bladerub.plots.polar import casing_polar, wear_profiles
from bladerub.plots.runs import histories
from bladerub.plots.scales import Scales
from bladerub.study.grid import CoatingCase

RANGE = (5e-7, 5e-4)
ANGLE = np.linspace(0, 2 * np.pi, 60, endpoint=False)
SCALES = Scales(modulus_unit=0.6e9, length=0.066, f1_hz=850.0, nominal_speed=15300.0)  # f_omega = 0.3
PEAKS = pd.DataFrame(
    [
        ("2nd", 1.1, 0.5, 0.0, 4, 0.31, 2e-3),
        ("2nd", 0.11, 0.5, 0.0, 4, 0.30, 1e-3),
        ("2nd", 0.11, 5.0, 0.0, 4, 0.32, 3e-3),
        ("2nd", 1.1, 0.5, 0.0, 6, 0.2, 9e-3),
    ],
    columns=["casing", "E", "K", "theta", "order", "f_peak", "amplitude"],
)


def second(axes, along):
    axes.figure.canvas.draw()
    (found,) = [child for child in axes.child_axes if getattr(child, f"get_{along}label")()]
    return getattr(found, f"get_{along}lim")()


def test_depth_over_speed_and_angle_and_the_speed_of_the_rotor(coating_map, draws):
    upper, lower, _ = draws(wear_map(coating_map, SCALES)).axes
    mesh = upper.collections[0]
    np.testing.assert_allclose(mesh.get_array().reshape(40, 6), 1e3 * coating_map.wear.T)
    np.testing.assert_allclose(mesh.get_coordinates()[:, 0, 1], np.arange(41) * 9.0, atol=1e-9)  # degrees
    completed, early, *_ = lower.lines
    np.testing.assert_array_equal(completed.get_ydata(), [5, 5, 10, 5, 5])
    np.testing.assert_array_equal(early.get_xydata(), [[0.35, 4]])
    assert second(lower, "x") == pytest.approx(60 * 850 * np.array(lower.get_xlim()))
    assert lower.lines[-1].get_xdata()[0] == pytest.approx(0.3)  # the nominal speed


def test_amplitudes_and_c1_lie_on_their_frequency_on_the_given_scale(coating_map, draws):
    axes, *_ = draws(spectrum_map(coating_map, RANGE, f_max=2.5)).axes
    mesh = axes.collections[0]
    np.testing.assert_allclose(mesh.get_array().reshape(6, -1)[4], 1e3 * coating_map.spectrum_amplitude[4])
    assert (mesh.norm.vmin, mesh.norm.vmax) == pytest.approx((5e-4, 0.5))
    corners = mesh.get_coordinates()
    of_peak = (corners[4, 40] + corners[5, 41]) / 2  # f_Ω = 0.3, eo(4)
    np.testing.assert_allclose(of_peak, [4 * 0.3, 0.3], rtol=1e-2)
    (c1,) = [line for line in axes.lines if line.get_label() == "$C_1$"]
    np.testing.assert_array_equal(c1.get_xydata(), np.transpose([coating_map.C1, coating_map.f_omega]))


def test_peaks_are_drawn_with_their_curves(config, coating_map, draws):
    settings = config.analysis.peaks.replaced("order_halfwidth", 0.0)
    table, figure = peak_sections(coating_map, settings, RANGE, f_max=2.5)
    lines = draws(figure).axes[1].lines
    curves = [line.get_xdata() for line in lines if line.get_label().startswith("eo(")]
    np.testing.assert_allclose(curves, 1e3 * coating_map.spectrum_amplitude[:, [40, 60]].T)
    np.testing.assert_array_equal(table.amplitude, np.ravel(curves) / 1e3)
    rings = [line.get_xydata().tolist() for line in lines if line.get_label() == "_peak"]
    assert rings[0] == [[0.1, 0.3]]


def test_casing_is_magnified_inward(draws):
    inward = {"2": 1e-3 * np.cos(2 * ANGLE)}
    (axes,) = draws(casing_polar(ANGLE, inward, radius=0.65, magnification=100)).axes
    circle, two = axes.lines
    np.testing.assert_allclose(circle.get_ydata(), 0.65)
    np.testing.assert_allclose(two.get_ydata()[:-1], 0.65 - 0.1 * np.cos(2 * ANGLE))
    assert np.ptp(two.get_xdata()) == pytest.approx(2 * np.pi)  # closed


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


def test_a_campbell_diagram_has_both_models_on_both_scales(draws):
    speed = np.linspace(0, 0.4, 5)
    modes = np.sqrt(np.array([1, 9, 25])[None] + 4 * speed[:, None] ** 2)
    mode, f_omega = np.meshgrid([1, 2, 3], speed)
    columns = {"f_omega": f_omega, "mode": mode, "f_fe": 850 * modes, "f_rom": 850 * 1.01 * modes}
    table = pd.DataFrame({name: values.ravel() for name, values in columns.items()})
    for axes in draws(campbell(table, SCALES)).axes:
        for labels, drawn in ((("finite elements", "_fe"), modes), (("reduced model", "_rom"), 1.01 * modes)):
            lines = [line.get_ydata() for line in axes.lines if line.get_label() in labels]
            np.testing.assert_allclose(np.transpose(lines), drawn)
        assert second(axes, "x") == pytest.approx((0, 20400))
        assert second(axes, "y") == pytest.approx(850 * np.array(axes.get_ylim()))


def test_an_extra_speed_opens_no_gap_and_missing_speeds_do():
    edges, rows = maps.with_gaps([0.18, 0.19, 0.197, 0.2], np.eye(4))
    np.testing.assert_allclose(edges, [0.175, 0.185, 0.1935, 0.1985, 0.2015])
    np.testing.assert_array_equal(rows, np.eye(4))
    edges, rows = maps.with_gaps([0.1, 0.11, 0.12, 0.3, 0.31], np.arange(5.0)[:, None])
    np.testing.assert_allclose(edges, [0.095, 0.105, 0.115, 0.13, 0.29, 0.305, 0.315])
    np.testing.assert_array_equal(rows[:, 0], [0, 1, 2, np.nan, 3, 4])


def test_amplitudes_of_one_order_are_bars_in_mm(draws, monkeypatch):
    bars = []
    monkeypatch.setattr(Axes3D, "bar3d", lambda self, *bar, **look: bars.append(bar))
    table, figure = peak_histogram(PEAKS, "amplitude", order=4, unit=600e6)
    pd.testing.assert_frame_equal(table, PEAKS[PEAKS.order == 4].drop(columns="f_peak"))
    ((x, y, floor, width, depth, height),) = bars
    places = np.rint(np.transpose([x + width / 2, y + depth / 2])).astype(int)
    np.testing.assert_array_equal(places, [[0, 0], [0, 1], [1, 0]])
    np.testing.assert_allclose(floor + height, [1.0, 3.0, 2.0])
    draws(figure)


def test_displacements_in_mm_on_one_scale_and_the_growth_of_both_runs(write_run, make_result, case, draws):
    steady, growing = make_result(), make_result(growth=0.2, complete=15)
    straight = write_run("straight.h5", result=steady, history=True, case=replace(case, theta=0.0))
    table, figure = histories([straight, write_run("leaning.h5", result=growing, history=True)])
    axes = draws(figure).axes
    for panel, result in zip(axes, (steady, growing), strict=False):
        np.testing.assert_allclose(panel.lines[0].get_ydata(), 1e3 * result.radial_displacement)
    assert axes[0].get_ylim() == axes[1].get_ylim()
    for line, result in zip(axes[2].lines, (steady, growing), strict=True):
        expected = np.transpose([np.arange(20) + 0.5, 1e3 * result.revolution_amplitude])
        np.testing.assert_allclose(line.get_xydata(), expected)
    assert list(table.columns) == ["theta", "revolution", "radial_displacement"]
    leaning = table[table.theta == 0.15].radial_displacement
    np.testing.assert_array_equal(leaning, growing.radial_displacement)


def test_equal_figures_give_equal_files_and_leave_the_settings_of_the_session_alone(tmp_path):
    before = dict(matplotlib.rcParams)

    @style.styled
    def draw():
        assert matplotlib.rcParams["axes.spines.top"] is False
        figure = style.new_figure(2, 1)
        figure.add_subplot().plot([0, 1])
        return figure

    for name in "ab":
        style.save(draw(), tmp_path / f"{name}.png", tmp_path / f"{name}.pdf", dpi=50)
    for suffix in ("png", "pdf"):
        assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"b.{suffix}").read_bytes()
    assert dict(matplotlib.rcParams) == before


def test_logarithmic_axes_without_data_are_drawn(draws):
    figure = style.new_figure(2, 1)
    for axes, data in zip(figure.subplots(1, 3, sharey=True), ([], [math.nan], [0.1]), strict=True):
        axes.plot(data, data)
        axes.set(xscale="log", yscale="log")
    axes = draws(figure).axes
    assert [one.get_xscale() for one in axes] == ["linear", "linear", "log"]
    assert {one.get_yscale() for one in axes} == {"log"}


COATING = Coating(2.0, 0.5, 0.15, yield_stress=0.0, modulus_unit=1e8, thickness=5e-3, n_elements=2000)
SCENE = pressed_elements(COATING, TipProfile(half_width=1.0, edge_drop=20e-6), 0.65, depth=1e-4, reach=3)


def test_elements_reach_from_the_surface_to_the_casing_at_their_angle_and_are_worn(draws):
    shape, heights = draws(tip_profile(SCENE)).axes
    corners = np.array([path.vertices[:4] for path in shape.collections[0].get_paths()])
    np.testing.assert_allclose(corners[:, 0, 1], 1e3 * SCENE.shortening, atol=1e-12)
    np.testing.assert_allclose(corners[:, 2, 1], 5.0)
    lean = corners[:, 3] - corners[:, 0]
    np.testing.assert_allclose(lean[:, 0] / lean[:, 1], np.tan(0.15))
    _, elastic, worn = ([bar.get_height() for bar in bars] for bars in heights.containers)
    np.testing.assert_allclose(worn, 1e6 * SCENE.wear)  # μm
    np.testing.assert_allclose(elastic, 1e6 * (SCENE.shortening - SCENE.wear), atol=1e-9)


def tower(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Stack n unit cubes of 20 nodes: points and connectivity."""
    mesh, _ = hexahedral_mesh([0, 1], [0, 1], np.arange(n + 1.0), lambda *cube: np.stack(cube))
    return mesh.points, mesh.cells


def test_outer_faces_alone_are_found_whose_normals_point_outward():
    points, hexahedra = tower(3)
    faces = boundary_faces(hexahedra)
    assert faces.shape == (14, 8)
    polygons = points[faces]
    outward = polygons.mean(axis=1) - points.mean(axis=0)
    assert (np.einsum("ij,ij->i", normals(polygons), outward) > 0).all()
    steps = np.linalg.norm(np.diff(polygons, axis=1), axis=2)
    np.testing.assert_allclose(steps, 0.5)  # from a corner to the next mid-side node


def test_view_from_the_front():
    eye = np.array([0.0, -1.0, 0.0])  # looking along +y: x to the right, z up
    np.testing.assert_allclose(project(np.eye(3), eye), [[1, 0], [0, 0], [0, 1]], atol=1e-12)
    points, hexahedra = tower(2)
    polygons = points[boundary_faces(hexahedra)]
    seen = front_faces(polygons, eye)
    np.testing.assert_allclose(polygons[seen][:, :, 1], 0, atol=1e-12)
    assert len(seen) == 2
