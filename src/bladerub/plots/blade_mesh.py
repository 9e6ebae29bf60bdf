"""The blade's mesh, or its nodes alone, with its clamped root and the interface nodes."""

from pathlib import Path

import numpy as np
from matplotlib import colors
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.markers import CARETUP

from bladerub.blade.surface import boundary_faces, normals
from bladerub.io import hdf5
from bladerub.plots.style import DARK, PAGE, RED, new_figure, on_axes

_METAL = np.array(colors.to_rgb("#c3ccd6"))
_LIGHT = np.array([-0.35, 0.85, 0.40])
_ELEVATION, _AZIMUTH = np.radians([24, 102])  # over the x-y plane, and in it from x towards y
_LEVEL = np.cos(_ELEVATION)
_EYE = np.array([_LEVEL * np.cos(_AZIMUTH), _LEVEL * np.sin(_AZIMUTH), np.sin(_ELEVATION)])
"""Where the pressure side is seen from, with the tip face and the twist in sight."""
_EDGES = {"edgecolors": DARK, "linewidths": 0.35}
_INTERFACE = {"marker": "o", "ms": 6, "color": RED, "ls": "none", "mec": "white", "mew": 0.5}
_ROOT = {"marker": CARETUP, "ms": 5, "color": DARK, "ls": "none", "mew": 0.3}
_NODE = {"marker": ".", "linestyle": "none", "markeredgewidth": 0}
_KINDS = {20: "hexahedra", 10: "tetrahedra"}
_AXES = ("x, axial ", "right", "center"), ("y, rotation", "center", "top"), ("z, radial", "center", "bottom")
_AXIS = 35  # length of the drawn axes, mm


def project(points: np.ndarray, eye: np.ndarray = _EYE) -> np.ndarray:
    """Place (..., 2) in the picture, z upwards, of points (..., 3) seen from the unit vector `eye` (3,)."""
    horizontal = np.cross([0, 0, 1], eye)
    horizontal /= np.linalg.norm(horizontal)
    return points @ np.stack([horizontal, np.cross(eye, horizontal)], axis=1)


def front_faces(polygons: np.ndarray, eye: np.ndarray = _EYE) -> np.ndarray:
    """List the faces among (n, 8 or 6, 3) that are turned to the `eye`, the farthest first."""
    facing = np.flatnonzero(normals(polygons) @ eye > 1e-6)  # not those seen edge-on
    return facing[np.argsort((polygons[facing] @ eye).mean(axis=1))]


@on_axes
def blade_mesh(mesh: str | Path, ax: Axes | None = None) -> Figure:
    """Draw Fig. 1: the mesh with root and interface nodes (a), and the tip seen along the radius (b).

    `mesh` is the file ``mesh.h5`` of a blade. Where another program has left out the elements, the nodes are
    drawn. Axes that are given hold (a). Raises `OSError` if the file cannot be read.
    """
    data, _ = hdf5.read(mesh)
    points, elements = data["points"], data["cells"]
    interface, root, tip = (data[f"{name}_nodes"] for name in ("interface", "root", "tip"))
    millimetres, faces = 1e3 * points, boundary_faces(elements)
    if ax is not None:
        _draw_whole(ax, millimetres, faces, interface, root)
        ax.legend(loc="best")
        return ax.figure
    figure = new_figure(PAGE, 0.86 * PAGE)
    overview, of_tip = figure.subplots(1, 2, width_ratios=[1, 1.05])
    _draw_whole(overview, millimetres, faces, interface, root)
    counted = f"{len(elements)} {_KINDS[elements.shape[1]]}, " if len(elements) else ""
    overview.set_title(f"(a) {counted}{len(points)} nodes")
    if not len(elements):
        of_tip.plot(*millimetres[tip, :2].T, color=DARK, markersize=5, **_NODE)
    _draw_tip(of_tip, millimetres, faces[np.isin(faces, tip).all(axis=1)], interface)
    figure.legend(*overview.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


def _draw_whole(
    axes: Axes, points: np.ndarray, faces: np.ndarray, interface: np.ndarray, root: np.ndarray
) -> None:
    polygons = points[faces]
    visible = front_faces(polygons)
    shade = 0.5 + 0.5 * np.clip(normals(polygons[visible]) @ _LIGHT, 0, 1)
    if len(root):
        axes.plot(*project(points[root]).T, label="clamped root nodes", zorder=0.5, **_ROOT)
    if not len(faces):
        axes.plot(*project(points).T, color=_METAL * 0.75, markersize=2.5, label="_nodes", **_NODE)
    drawn, colours = project(polygons[visible]), shade[:, None] * _METAL
    axes.add_collection(PolyCollection(drawn, facecolors=colours, **_EDGES))
    axes.plot(*project(points[interface]).T, label="interface nodes", **_INTERFACE)
    axes.set_aspect("equal")
    axes.margins(0.03)
    axes.set_axis_off()
    _draw_directions(axes, points[interface].mean(axis=0) + np.array([45, 0, -45]))


def _draw_directions(axes: Axes, origin: np.ndarray) -> None:
    for direction, (name, ha, va) in zip(np.eye(3), _AXES, strict=True):
        foot, head = project(np.stack([origin, origin + _AXIS * direction]))
        axes.plot(*np.transpose([foot, head]), color=DARK, linewidth=0.9, label="_direction")
        axes.annotate("", head, foot, arrowprops={"arrowstyle": "-|>", "color": DARK, "linewidth": 0})
        axes.annotate(name, head, ha=ha, va=va, fontsize=7.5, annotation_clip=False)


def _draw_tip(axes: Axes, points: np.ndarray, faces: np.ndarray, interface: np.ndarray) -> None:
    """Look inward along z at the `faces` of the tip."""
    axes.add_collection(PolyCollection(points[faces][:, :, :2], facecolors=_METAL, **_EDGES))
    nodes = points[interface, :2]
    axes.plot(*nodes.T, **_INTERFACE)
    placement = {"textcoords": "offset points"}
    side = 1 if nodes[0, 0] <= nodes[-1, 0] else -1  # where the corner above the tip is free
    alignment = "left" if side > 0 else "right"
    for number, node in enumerate(nodes, start=1):
        axes.annotate(str(number), node, xytext=(6 * side, 4), ha=alignment, color=RED, **placement)
    axes.annotate("leading edge", nodes[0], xytext=(0, 14), ha="center", va="bottom", **placement)
    axes.annotate("trailing edge", nodes[-1], xytext=(0, -14), ha="center", va="top", **placement)
    arrow = {"xycoords": "axes fraction", "arrowprops": {"arrowstyle": "-|>", "color": DARK}}
    across = 0.5 + 0.35 * side
    axes.annotate("rotation", (across, 0.95), (across, 0.75), ha="center", **arrow)
    axes.set(aspect="equal", xlabel="axial x (mm)", ylabel="tangential y (mm)")
    axes.set_title("(b) the tip from outside")
    axes.margins(0.22)
