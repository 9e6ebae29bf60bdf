import math

import matplotlib

from bladerub.plots import style, titles
from bladerub.study.grid import CoatingCase


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


def test_coatings_are_named_by_their_law():
    coulomb = CoatingCase("2nd", 2.0, 0.5, math.atan(0.15), "coulomb")
    assert titles.coating(CoatingCase("2nd", 2.0, 0.5, 0.15)) == "casing 2nd, E = 2, K = 0.5, θ = 0.15 rad"
    assert titles.coating(coulomb) == "casing 2nd, E = 2, K = 0.5, μ = 0.15"
    assert titles.coating(CoatingCase.rigid("2nd", 0.15)) == "rigid casing 2nd, μ = 0.15"
