import matplotlib

from bladerub.plots import style


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
