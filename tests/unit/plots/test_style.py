import matplotlib

from bladerub.plots import style, titles
from bladerub.study.grid import CoatingCase


def test_the_style_leaves_the_settings_of_the_session_alone(tmp_path):
    before = dict(matplotlib.rcParams)

    @style.styled
    def draw():
        assert matplotlib.rcParams["axes.spines.top"] is False
        return style.new_figure(2, 1)

    style.save(draw(), tmp_path / "a.png", tmp_path / "a.pdf", dpi=50)
    assert dict(matplotlib.rcParams) == before


def test_equal_figures_give_equal_files(tmp_path):
    @style.styled
    def draw():
        figure = style.new_figure(2, 1)
        figure.add_subplot().plot([0, 1])
        return figure

    for name in "ab":
        style.save(draw(), tmp_path / f"{name}.png", tmp_path / f"{name}.pdf", dpi=50)
    for suffix in ("png", "pdf"):
        assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"b.{suffix}").read_bytes()


def test_coatings_are_named_in_full():
    assert (
        titles.coating(CoatingCase("2nd", 0.11, 0.5, 0.15)) == "casing 2nd, E = 0.11, K = 0.5, θ = 0.15 rad"
    )
    assert titles.coating(CoatingCase("2nd5nd", 11.0, 10.0, 0.0)) == "casing 2nd5nd, E = 11, K = 10, θ = 0"


def test_coulomb_friction_is_named_by_its_coefficient():
    case = CoatingCase("2nd", 2.0, 0.5, 0.15, "coulomb")
    assert titles.coating(case) == f"casing 2nd, E = 2, K = 0.5, μ = {case.friction:g}"


def test_the_rigid_casing_is_named_with_its_friction():
    assert titles.coating(CoatingCase.rigid("2nd", 0.0)) == "rigid casing 2nd, μ = 0"
    assert titles.coating(CoatingCase.rigid("2nd", 0.15)) == "rigid casing 2nd, μ = 0.15"


def test_speeds_have_three_decimals():
    assert titles.speed(0.19) == r"$f_\Omega$ = 0.190"


def test_panels_are_lettered():
    assert [titles.panel(index, "eo(4)") for index in (0, 1)] == ["(a) eo(4)", "(b) eo(4)"]
