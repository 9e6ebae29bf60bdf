import itertools

import numpy as np
import pytest
from blade_parts import REDUCTION, TITANIUM, TWISTED, section
from tetrahedra import tetrahedral_mesh

from bladerub.blade.build import meshed_blade, reduce_meshed
from bladerub.blade.geometry import BladeShape, lattice
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.surface import boundary_faces
from bladerub.extras.blades.importing import facing, import_blade
from bladerub.extras.blades.origin import Frame
from bladerub.extras.blades.profile import interface
from bladerub.extras.blades.report import mesh_report
from bladerub.extras.blades.settings import Source
from bladerub.extras.export.mesh_file import write_mesh_file
from bladerub.io.errors import BadInput
from bladerub.settings.blade import BladeSpec, Mesh


@pytest.fixture
def blade():
    return meshed_blade(TWISTED.replaced("tip_cone", 9.0)).mesh


@pytest.fixture
def write(blade, tmp_path):
    def file(name="blade.inp", points=None, cells=None, **node_sets):
        sets = {"ROOT": blade.root, "TIP": blade.tip} | node_sets
        points = blade.mesh.points if points is None else points
        write_mesh_file(tmp_path / name, points, blade.mesh.cells if cells is None else cells, sets)
        return tmp_path / name

    return file


def imported(path, **source):
    return import_blade(Source(file=str(path), **source), TWISTED.mesh)


@pytest.mark.parametrize("name", ["blade.inp", "blade.msh", "blade.vtu"])
@pytest.mark.parametrize("sets", [{}, {"root_set": "ROOT", "tip_set": "tip"}], ids=["by rule", "by name"])
def test_the_blade_comes_back_from_its_file(blade, write, name, sets):
    read = imported(write(name), **sets).blade
    mesh = read.mesh
    for nodes in ("root", "tip", "interface"):
        ours, theirs = (of.mesh.points[getattr(of, nodes)] for of in (blade, mesh))
        if nodes != "interface":
            ours, theirs = np.unique(ours, axis=0), np.unique(theirs, axis=0)
        np.testing.assert_array_equal(theirs, ours)
    assert np.rad2deg(read.tip_cone) == pytest.approx(9.0, abs=1e-9)
    assert read.length == pytest.approx(0.2, rel=0.01)


def test_flow_against_x_turns_the_interface_and_the_cone_around_and_loose_nodes_are_left_out(blade, write):
    path = write(points=1e3 * blade.mesh.points)
    read = imported(path, unit="mm", downstream="-x", tip_cone=-9.0).blade
    mesh, ours = read.mesh, blade.mesh.points[blade.interface]
    np.testing.assert_allclose(mesh.mesh.points[mesh.interface], ours[::-1], atol=1e-15)
    assert np.rad2deg(read.tip_cone) == pytest.approx(9.0)
    loose = write(points=np.vstack([blade.mesh.points, [[0, 0, 0], [9, 9, 9]]]))
    read = imported(loose)
    assert read.n_unused == 2
    assert len(read.blade.mesh.mesh.points) == len(blade.mesh.points)


def test_figures_are_those_of_the_mesh_and_what_is_odd_gets_a_warning(blade, write):
    source = Source(file=str(write("blade.vtu")))
    read = import_blade(source, TWISTED.mesh)._replace(interface_offset=0.004)
    reduction = REDUCTION.replaced("modes_per_speed", 6).replaced("rank_tolerance", 1e-6)
    built = reduce_meshed(read.blade, BladeSpec(blade=TWISTED, reduction=reduction))
    figures = mesh_report(source, read, built, TITANIUM)
    assert figures["unknowns"] == 3 * (figures["nodes"] - built.mesh.root.size)
    assert figures["mass"] == pytest.approx(4430.0 * figures["volume"])
    farthest = np.hypot(*blade.mesh.points[:, 1:].T).max()
    assert figures["extents"]["radius"] == pytest.approx([0.45, farthest])
    first = built.accuracy[built.accuracy["mode"] == 1].f_fe.to_numpy()
    assert (figures["f1_hz"], figures["campbell_ratio"]) == (built.frequency[0], first[-1] / first[0])
    assert max(figures["error_eq2"]) < 1e-6  # the three speeds are those of the fit
    assert figures["error_reduced_model"][0] < 1e-3
    assert (figures["elements_root_to_tip"], len(figures["warnings"])) == (3, 2)  # coarse, and off its place


def test_broken_meshes_are_refused_with_file_and_culprit(blade, write):
    points, cells = blade.mesh.points, blade.mesh.cells
    corner = cells[5, 0]
    nan, inside_out = points.copy(), points.copy()
    nan[corner] = np.nan
    inside_out[corner] += [0, 0.05, 0]
    twin = points.copy()
    twin[cells[0, 0]] = points[cells[-1, 6]]
    swapped = cells[:, [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 10, 9, *range(12, 20)]]
    loose = cells.copy()
    shared = np.intersect1d(cells[0, 8:], cells[1, 8:])[0]
    loose[1, cells[1] == shared] = len(points)
    near = points[shared] + 1e-4
    collapsed = cells.copy()
    collapsed[2, 1] = collapsed[2, 0]
    second = (np.vstack([points, points * [1, -1, -1]]), np.vstack([cells, cells + len(points)]))
    cases = [
        ({"points": nan}, {}, f"node {corner + 1}: is at nan, .* must be finite"),
        ({"cells": collapsed}, {}, "element 3: has a node twice"),
        ({"points": second[0], "cells": second[1]}, {}, "has 2 bodies that share no nodes"),
        ({"points": twin}, {}, "are in one place; merge them"),
        ({"cells": swapped}, {}, "element 1: its 10th node is not in the middle of its edge"),
        ({"points": points * [1, -1, 1]}, {}, "all elements are left-handed"),
        ({"points": inside_out}, {}, "its Jacobian is negative|not in the middle"),
        ({"points": np.vstack([points, near]), "cells": loose}, {}, "must share the mid-side nodes"),
        ({}, {"tip_set": "hub"}, 'tip not found: there is no node set "hub"; there are ROOT, TIP'),
        ({"TIP": blade.root}, {"tip_set": "TIP"}, "root and tip share nodes"),
        ({"ROOT": blade.tip, "TIP": blade.root}, {"root_set": "ROOT", "tip_set": "TIP"}, "no farther from"),
    ]
    for number, (content, source, said) in enumerate(cases):
        path = write(f"broken{number}.inp", **content)
        with pytest.raises(BadInput, match=said) as caught:
            imported(path, **source)
        assert str(caught.value).startswith(f"{path}: ")
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("degrees", "is_part"), [(40.0, True), (50.0, False)])
def test_the_tip_is_what_faces_within_45_degrees_of_the_radius(degrees, is_part):
    fall = np.tan(np.deg2rad(degrees))

    def points(xi, eta, zeta):
        x = xi - 0.5
        return np.stack([x, 0.1 * (eta - 0.5), 10 + zeta * (1 - fall * np.maximum(x, 0))])

    mesh, (xi, _, zeta) = hexahedral_mesh(*(np.linspace(0, 1, n + 1) for n in (4, 1, 2)), points)
    tip = facing(mesh.points, boundary_faces(mesh.cells), outwards=True)
    np.testing.assert_array_equal(tip, np.flatnonzero((zeta == 1) & (is_part | (xi <= 0.5))))


def tip_of(config, make_mesh=hexahedral_mesh, counts=TWISTED.mesh):
    shape = BladeShape.from_config(config)
    mesh, cube = make_mesh(*lattice(counts), shape.points)
    faces = boundary_faces(mesh.cells)
    return shape, mesh.points, faces[(cube[2][faces] == 1).all(axis=1)]


@pytest.mark.parametrize("camber", [0.0, 30.0, 80.0])
@pytest.mark.parametrize("make_mesh", [hexahedral_mesh, tetrahedral_mesh])
def test_interface_nodes_lie_evenly_on_the_camber_line(blade_config, make_mesh, camber):
    blade = blade_config.replaced("sections", [section(0.0), section(1.0, camber=camber, stagger=40.0)])
    counts = Mesh.model_construct(chordwise=28, thickness=2, spanwise=1)
    shape, points, faces = tip_of(blade, make_mesh, counts)
    nodes, chord, offset = interface(points, faces, 1, 8)
    line = shape.points(np.linspace(0, 1, 2001), 0.5, 1.0).T
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    evenly = np.stack([np.interp(np.linspace(0, arc[-1], 8), arc, column) for column in line.T], axis=1)
    off = np.linalg.norm(points[nodes] - evenly, axis=1)
    assert chord == pytest.approx(arc[-1], rel=3e-3)
    assert off.max() < 0.6 * arc[-1] / 56  # half the distance of nodes along the chord, and a little
    assert offset < 0.6 * arc[-1] / 56


@pytest.mark.parametrize("angle", [180.0, -120.0])
def test_where_the_blade_stands_does_not_matter(angle):
    _, points, faces = tip_of(TWISTED)
    c, s = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    turned = points @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    (nodes, chord, _), (other_nodes, other_chord, _) = (interface(p, faces, 1, 8) for p in (points, turned))
    np.testing.assert_array_equal(nodes, other_nodes)
    assert other_chord == pytest.approx(chord, rel=1e-9)


def test_every_frame_is_turned_never_mirrored_and_axes_that_do_not_go_together_are_refused():
    vectors = dict(zip(("x", "y", "z", "-x", "-y", "-z"), np.vstack([np.eye(3), -np.eye(3)]), strict=True))
    axes = [of for of in itertools.product(vectors, repeat=3) if of[1][-1] == of[0][-1] != of[2][-1]]
    assert len(axes) == 48
    for frame in [Frame("m", *of) for of in axes]:
        assert np.linalg.det(frame.turn) == pytest.approx(1.0)
        radial, along = frame.metres(np.stack([vectors[frame.radial], vectors[frame.downstream]]))
        np.testing.assert_array_equal(radial, [0, 0, 1])
        np.testing.assert_array_equal(along, [frame.downstream_x, 0, 0])
        tip = vectors[frame.radial]
        _, y, z = frame.metres(tip + 1e-3 * np.cross(vectors[frame.rotation], tip))
        assert np.arctan2(y, z) == pytest.approx(1e-3, rel=1e-5)
    with pytest.raises(ValueError, match="downstream = y: must be along the axis of rotation, x or -x"):
        Frame(downstream="y")
    with pytest.raises(ValueError, match="radial = -x: must not be the axis of rotation"):
        Frame(radial="-x")
