import numpy as np
import pytest
from blade_parts import tetrahedral_mesh

from bladerub.blade.build import build
from bladerub.blade.files import made_from
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.geometry import BladeShape, lattice
from bladerub.blade.mesh import BladeMesh
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.origin import Source
from bladerub.extras.export.mesh_file import write_mesh_file
from bladerub.io.errors import BadInput

REDUCTION = {
    "f_omega_max": 0.4,
    "modes_per_speed": 3,
    "rank_tolerance": 1e-5,
    "accuracy_speeds": 3,
    "accuracy_modes": 8,
}


@pytest.fixture
def blade(twisted_config):
    twisted_config["tip_cone"] = 9.0
    return BladeMesh.from_shape(BladeShape.from_config(twisted_config), twisted_config["mesh"])


@pytest.fixture
def write(blade, tmp_path):
    """Write the blade with other points or elements, and say where."""

    def file(name="blade.inp", points=None, cells=None, **node_sets):
        sets = {"ROOT": blade.root, "TIP": blade.tip} | node_sets
        points = blade.mesh.points if points is None else points
        write_mesh_file(tmp_path / name, points, blade.mesh.cells if cells is None else cells, sets)
        return tmp_path / name

    return file


@pytest.mark.parametrize("name", ["blade.inp", "blade.msh", "blade.vtu"])
@pytest.mark.parametrize("sets", [{}, {"root_set": "ROOT", "tip_set": "tip"}], ids=["by rule", "by name"])
def test_the_blade_comes_back_from_its_file(blade, write, name, sets):
    imported = import_blade(Source(write(name), **sets), {})
    mesh = imported.blade.mesh
    for nodes in ("root", "tip", "interface"):
        ours, theirs = getattr(blade, nodes), getattr(mesh, nodes)
        a, b = blade.mesh.points[ours], mesh.mesh.points[theirs]
        if nodes != "interface":
            a, b = np.unique(a, axis=0), np.unique(b, axis=0)
        np.testing.assert_array_equal(a, b)
    assert np.rad2deg(imported.blade.tip_cone) == pytest.approx(9.0, abs=1e-9)
    assert imported.blade.length == pytest.approx(0.2, rel=0.01)
    assert imported.n_unused == 0
    assert imported.jacobian_ratio.min() > 0


def test_its_frequencies_come_back_as_well(twisted_config, tmp_path):
    name = "blade.inp"
    config = {"blade": twisted_config, "reduction": REDUCTION}
    ours = build(config)
    sets = {"root": ours.mesh.root, "tip": ours.mesh.tip}
    write_mesh_file(tmp_path / name, ours.mesh.mesh.points, ours.mesh.mesh.cells, sets)
    theirs = build(config | {"blade": twisted_config | {"source": {"file": str(tmp_path / name)}}})
    np.testing.assert_allclose(theirs.frequency, ours.frequency, rtol=1e-9)
    np.testing.assert_allclose(theirs.accuracy.f_fe, ours.accuracy.f_fe, rtol=1e-9)
    for f_omega in (0.0, 0.3):
        a, b = (reduced_frequencies(blade.reduced, f_omega, 8) for blade in (ours, theirs))
        np.testing.assert_allclose(b, a, rtol=1e-8)
    np.testing.assert_allclose(theirs.reduced.radial_direction, ours.reduced.radial_direction, atol=1e-12)


def test_the_same_blade_in_other_axes_and_units(blade, write):
    # x of the file along the blade, its z upstream: the blade turns about +z there, as it does about -x here
    turn = np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]], dtype=float)
    frame = Frame("mm", rotation="z", downstream="-z", radial="x")
    np.testing.assert_array_equal(frame.turn, turn)
    path = write("turned.inp", points=1e3 * blade.mesh.points @ turn)
    mesh = import_blade(Source(path, frame), {}).blade.mesh
    found = mesh.mesh.points[mesh.interface]
    np.testing.assert_allclose(found, blade.mesh.points[blade.interface], atol=1e-15)


def test_flow_against_x_turns_the_interface_and_the_cone_around(blade, write):
    imported = import_blade(Source(write(), Frame(downstream="-x"), tip_cone=-9.0), {})
    mesh = imported.blade.mesh
    ours = blade.mesh.points[blade.interface]
    np.testing.assert_array_equal(mesh.mesh.points[mesh.interface], ours[::-1])
    assert np.rad2deg(imported.blade.tip_cone) == pytest.approx(9.0)


def test_tetrahedra_become_a_blade(twisted_config, tmp_path):
    counts = {"chordwise": 14, "thickness": 2, "spanwise": 6}
    mesh, cube = tetrahedral_mesh(*lattice(counts), BladeShape.from_config(twisted_config).points)
    write_mesh_file(tmp_path / "blade.msh", mesh.points, mesh.cells, {})
    found = import_blade(Source(tmp_path / "blade.msh"), {}).blade.mesh
    for nodes, end in ((found.root, 0), (found.tip, 1)):
        expected = mesh.points[cube[2] == end]
        np.testing.assert_array_equal(
            np.unique(found.mesh.points[nodes], axis=0), np.unique(expected, axis=0)
        )


def test_nodes_in_no_element_are_left_out(blade, write):
    imported = import_blade(Source(write(points=np.vstack([blade.mesh.points, [[0, 0, 0], [9, 9, 9]]]))), {})
    assert imported.n_unused == 2
    assert len(imported.blade.mesh.mesh.points) == len(blade.mesh.points)


def moved(points, nodes, by):
    changed = points.copy()
    changed[nodes] += by
    return changed


def test_broken_meshes_are_refused_with_file_and_culprit(blade, write):
    points, cells = blade.mesh.points, blade.mesh.cells
    corner = cells[5, 0]
    nan = moved(points, corner, np.nan)
    twin = points.copy()
    twin[cells[0, 0]] = points[cells[-1, 6]]
    swapped = cells[:, [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 10, 9, *range(12, 20)]]
    inside_out = moved(points, corner, [0, 0.05, 0])
    loose = cells.copy()
    shared = np.intersect1d(cells[0, 8:], cells[1, 8:])[0]
    loose[1, cells[1] == shared] = len(points)
    near = points[shared] + 1e-4
    collapsed = cells.copy()
    collapsed[2, 1] = collapsed[2, 0]
    second = (np.vstack([points, points * [1, -1, -1]]), np.vstack([cells, cells + len(points)]))
    cases = [
        ({"points": nan}, {}, f"node {corner + 1}: its coordinates are not finite"),
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
            import_blade(Source(path, **source), {})
        assert str(caught.value).startswith(f"{path}: ")
        assert "\n" not in str(caught.value)


def test_a_blade_is_of_its_file_not_of_the_sections(twisted_config, write):
    path = write()
    config = {"blade": twisted_config | {"source": {"file": str(path)}}, "reduction": REDUCTION}
    first = made_from(config)
    config["blade"]["hub_radius"] = 1.0
    assert made_from(config) == first
    path.write_text(path.read_text() + "** another\n")
    assert made_from(config) != first
