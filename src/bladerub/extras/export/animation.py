"""A run as an animation: the blades turn in the casing, seen along the axis, and the coating wears."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import tip_radii
from bladerub.contact.strips import element_angle
from bladerub.extras.export.recording import Recording
from bladerub.extras.rows.spec import Row
from bladerub.io import atomic
from bladerub.plots import titles
from bladerub.plots.polar import closed, prepare_polar
from bladerub.plots.style import BLUE, COLUMN, DARK, GREY, ORANGE, new_figure, styled
from bladerub.study.grid import CoatingCase

FRAMES_PER_SECOND = 12
_DPI = 90
_HUB, _TIP, _RING = 0.45, 0.8, 0.85  # radii in the picture; the worn depth is drawn outwards from the last


@styled
def animate(path: str | Path, recording: Recording, blade: ReducedBlade, row: Row, attributes: dict) -> None:
    """Write an animated GIF, whole or not at all: a frame for each instant of the `recording`.

    The worn depth (mean of the nodes) and the radial displacement of node 1 of each blade are drawn on the
    same scale, so magnified that the largest of them is seen; the shape of the casing is not drawn.
    """
    case, depth = CoatingCase.described(attributes), recording.wear.mean(axis=1)
    radial = recording.coordinates[:, :, :3] @ blade.radial_direction[0]  # of node 1, whose three come first
    scale = (1 - _RING) / max(depth.max(), np.abs(radial).max(), 1e-9)
    angle = element_angle(depth.shape[1])
    figure = new_figure(1.2 * COLUMN, 1.35 * COLUMN)
    axes = prepare_polar(figure.add_subplot(projection="polar"))
    axes.set_rlim(0, 1)
    axes.set_rgrids([_RING], [])
    axes.plot(*closed(angle, np.full(angle.size, _RING)), color=GREY, linewidth=0.8)
    axes.plot(np.linspace(0, 2 * np.pi, 181), np.full(181, _HUB), color=GREY, linewidth=0.8)
    (worn,) = axes.plot([], [], color=ORANGE, linewidth=1.2)
    lines = [axes.plot([], [], color=BLUE, linewidth=1.2)[0] for _ in row.blades]
    lines[0].set_color(DARK)
    title = axes.set_title("", fontsize=9)
    magnification = scale * tip_radii(blade)[0].mean() / _RING
    figure.supxlabel(f"wear and displacement magnified {magnification:.0f} times", fontsize=8)
    name = f"{titles.coating(case)}, {titles.speed(attributes['f_omega'])}"

    def draw(frame: int) -> list:
        time = recording.time[frame]
        worn.set_data(*closed(angle, _RING + scale * depth[frame]))
        for line, row_blade, moved in zip(lines, row.blades, radial[frame], strict=True):
            azimuth = row_blade.angle + 2 * np.pi * time
            line.set_data([azimuth, azimuth], [_HUB, _TIP + scale * moved])
        title.set_text(f"{name}\nrevolution {time:.2f}, greatest depth {1e3 * depth[frame].max():.3f} mm")
        return [worn, *lines, title]

    animation = FuncAnimation(figure, draw, frames=len(recording.time), blit=False)
    with TemporaryDirectory() as scratch, atomic.writing(path, "wb") as stream:
        file = Path(scratch) / "run.gif"  # the writer wants a path
        animation.save(file, PillowWriter(fps=FRAMES_PER_SECOND), dpi=_DPI)
        stream.write(file.read_bytes())
