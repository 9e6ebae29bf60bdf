import meshio
import numpy as np
import pytest
from blade_parts import TWISTED
from tetrahedra import tetrahedral_mesh

from bladerub.blade.mesh import hexahedral_mesh
from bladerub.extras.blade_meshes import EDGES
from bladerub.extras.blades import deck, file_source
from bladerub.extras.blades.mesh_file import read
from bladerub.extras.blades.settings import Source
from bladerub.extras.export.mesh_file import write_mesh_file

CORNERS = (np.array([0.0, 0.3, 1.0]), np.array([0.0, 1.0]), np.array([0.0, 0.6, 1.0]))


def bent(*cube):
    x, y, z = np.stack(cube)
    return np.stack([x + 0.1 * z**2, y - 0.2 * x * z, z + 0.05 * x**2])


def sets(content):
    return {name: sorted(map(int, nodes)) for name, nodes in content.node_sets.items()}


@pytest.mark.parametrize("suffix", [".inp", ".msh", ".VTU"])
@pytest.mark.parametrize("make_mesh", [hexahedral_mesh, tetrahedral_mesh])
def test_a_mesh_survives_its_file(make_mesh, suffix, tmp_path):
    mesh, cube = make_mesh(*CORNERS, bent)
    bottom, top = (np.flatnonzero(cube[2] == end) for end in (0, 1))
    named = {"ROOT": bottom, "TIP": top, "INTERFACE": top[:3]}
    write_mesh_file(tmp_path / f"m{suffix}", mesh.points, mesh.cells, named)
    content = read(tmp_path / f"m{suffix}")
    np.testing.assert_array_equal(content.points, mesh.points)
    np.testing.assert_array_equal(content.cells, mesh.cells)
    assert not content.is_raised
    assert sets(content) == {name: nodes.tolist() for name, nodes in named.items()}


@pytest.mark.parametrize(
    ("make_mesh", "kind"), [(hexahedral_mesh, "hexahedron"), (tetrahedral_mesh, "tetra")]
)
def test_linear_elements_get_the_middles_of_their_edges(make_mesh, kind, tmp_path):
    mesh, _ = make_mesh(*CORNERS, lambda *cube: np.stack(cube))
    n_corners = mesh.cells.shape[1] - len(EDGES[mesh.cells.shape[1]])
    linear = meshio.Mesh(mesh.points[: mesh.nvertices], [(kind, mesh.cells[:, :n_corners])])
    meshio.vtu.write(str(tmp_path / "m.vtu"), linear)
    content = read(tmp_path / "m.vtu")
    assert content.is_raised
    assert len(content.points) == len(mesh.points)
    np.testing.assert_allclose(content.points[content.cells], mesh.points[mesh.cells], atol=1e-15)


def test_a_deck_is_read_as_abaqus_reads_it_and_an_included_file_is_part_of_the_blade(tmp_path):
    (tmp_path / "the nodes.inp").write_text("1, 0, 0, 0,\n2, 1.D0,\n3, , 1\n")
    (tmp_path / "m.inp").write_text(
        "*PART, NAME=Blade\n*Node, nset=Early,\n input=the nodes.inp\n** comment\n  *NODE\n4, 0, 0, 1\n"
        "*ELEMENT,\nTYPE=C3D4T, ELSET=Eall\n10, 1, 2,\n3, 4\n*END PART\n*ASSEMBLY\n"
        "*INSTANCE, NAME=B-1, PART=Blade\n*END INSTANCE\n"
        "*NSET, NSET=Some, INSTANCE=B-1,\nGENERATE\n1, 3, 2\n4, 4\n"
        '*NSET, NSET="Some more"\nsome, B-1.2\n*NSET, NSET=OfElements, ELSET=B-1.EALL\n'
        "*ELSET, ELSET=_S_S2, INSTANCE=B-1\n10\n*SURFACE, NAME=Side\n_S_S2, S2\n*END ASSEMBLY\n"
    )
    content = read(tmp_path / "m.inp")
    np.testing.assert_array_equal(content.points[:4], [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    assert content.cells[:, :4].tolist() == [[0, 1, 2, 3]]
    expected = {"Early": [0, 1, 2], "Some": [0, 2, 3], "Side": [0, 1, 3]}
    assert sets(content) == expected | {key: [0, 1, 2, 3] for key in ("Some more", "OfElements")}
    assert content.volume_sets == ["Eall", "_S_S2"]
    main, nodes = tmp_path / "m.inp", tmp_path / "n.inp"
    main.write_text("*INCLUDE, INPUT=.\\n.inp\n")
    nodes.write_text("*NODE\n1, 0, 0, 0\n")
    blade = TWISTED.replaced("source", Source(file=str(main)))
    before = file_source.recipe(blade)
    assert file_source.files(blade.source) == [str(main), f"{tmp_path}/./n.inp"]
    nodes.write_text("*NODE\n1, 0, 0, 1\n")
    assert file_source.recipe(blade) != before


def test_faces_of_gmsh_in_abaqus_files_are_node_sets(tmp_path):
    # the first block is in no set here
    (tmp_path / "m.inp").write_text(
        "*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
        "*ELEMENT, type=T3D2\n1, 1, 2\n"
        "*ELEMENT, type=cps3, ELSET=Root\n2, 1, 2, 3\n"
        "*ELEMENT, type=M3D3, ELSET=Tip\n3, 1, 2, 4\n"
        "*ELEMENT, type=c3d4, ELSET=Volume1\n4, 1, 2, 3, 4\n"
    )
    assert sets(read(tmp_path / "m.inp")) == {"Root": [0, 1, 2], "Tip": [0, 1, 3]}


WEDGE = f"1, {', '.join(str(1 + node % 6) for node in range(15))}\n"
GROUPS = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "{line}"
2 1 "TIP"
3 1 "BLADE"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
4
1 1 2 1 1 3 4
2 2 2 1 1 1 2 3
3 4 2 1 1 1 2 3 4
4 4 2 1 1 2 3 4 5
$EndElements
"""


def test_physical_groups_of_gmsh_are_kept_apart_by_dimension(tmp_path):
    text = GROUPS.format(line="EDGE").replace("$Elements\n4\n", "$Elements\n5\n5 4 2 9 1 1 2 3 4\n")  # twice
    (tmp_path / "m.msh").write_text(text)
    content = read(tmp_path / "m.msh")
    assert sets(content) == {"EDGE": [2, 3], "TIP": [0, 1, 2]}
    assert content.volume_sets == ["BLADE"]
    assert len(content.cells) == 2


TETRAHEDRON = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n6, 0, 1, 1\n"


def test_what_is_no_usable_mesh_is_told(tmp_path):
    for name, text, said in (
        ("m.step", "solid", "must be a mesh file that ends in .inp, .msh, .vtu"),
        ("m.msh", "** cgx\n*NODE, NSET=Nall\n", r"begins with \*NODE, .*: rename it to m.inp"),
        ("m.vtu", "<VTKFile>", "does not end with </VTKFile>"),
        ("m.inp", TETRAHEDRON, "has no volume elements"),
        ("m.inp", TETRAHEDRON + "*ELEMENT, TYPE=C3D15\n" + WEDGE, "has wedge15.* into tetrahedra"),
        ("m.inp", TETRAHEDRON + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 9\n", "line 9: node 9 of element 1"),
        ("m.inp", TETRAHEDRON + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3,\n4, 5\n", "line 10: element 1 has 5 nodes"),
        ("m.inp", TETRAHEDRON + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 1, 4\n", "1 elements have"),
        ("m.inp", TETRAHEDRON + "*NSET, NSET=A, GENERATE\n1, 4, 0\n", "line 9: has 1, 4, 0, must be"),
        ("m.inp", TETRAHEDRON + "*NGEN\n1, 6, 2\n", r"line 8: has \*NGEN, which makes nodes"),
        ("m.inp", TETRAHEDRON + "*INSTANCE, PART=A\n0, 5, 0\n", r"has \*INSTANCE, which moves its part"),
        ("m.inp", TETRAHEDRON + "*INCLUDE, INPUT=m.inp\n", "line 8: .* includes itself"),
        ("m.msh", GROUPS.format(line="TIP"), "has several physical groups TIP"),
        ("m.msh", "\ufeff" + GROUPS.format(line="EDGE"), "byte order mark"),
        ("m.msh", GROUPS.replace("$Nodes", "$PartitionedEntities\n$Nodes"), "unpartition it"),
    ):
        (tmp_path / name).write_text(text)
        with pytest.raises(ValueError, match=said):
            read(tmp_path / name)


STEEL = {"young_modulus": 2.1e11, "poisson_ratio": 0.3, "density": 7850.0}
DECK = "*HEADING\nblade\n*MATERIAL, NAME={}\n*ELASTIC\n{}\n*DENSITY\n{}\n"


def test_the_material_of_a_deck_is_that_of_its_section_in_the_unit_of_length_and_must_be_isotropic(tmp_path):
    for unit, elastic, density in (("m", "2.1e11, .3,", "7850."), ("ft", "4.385941188e9, 0.3", "15.23120")):
        (tmp_path / "m.inp").write_text(DECK.format("Steel", elastic, density))
        assert deck.material(tmp_path / "m.inp", unit).plain() == pytest.approx(STEEL, rel=1e-4)
    other = DECK.format("Nickel", "205000, 0.31", "8.2e-9")
    section = '*Solid Section, elset=E, material="steel"\n'
    (tmp_path / "m.inp").write_text(other + DECK.format("Steel", "** MPa\n210000, 0.3", "7.85e-9") + section)
    assert deck.material(tmp_path / "m.inp", "mm").plain() == pytest.approx(STEEL)
    (tmp_path / "m.inp").write_text("*NODE\n1, 0, 0, 0\n")
    assert deck.material(tmp_path / "m.inp", "mm") is None
    (tmp_path / "m.inp").write_text("*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n")  # in a file of its own
    assert deck.material(tmp_path / "m.inp", "mm") is None
    for text, said in (
        (DECK.format("A", "210000, 0.3", "7.85e-9") + DECK.format("B", "1e5, 0.3", "5e-9"), "materials A, B"),
        ("*MATERIAL, NAME=A\n*ELASTIC\n210000, 0.3\n", "A has no .DENSITY"),
        (DECK.format("A", "210000,0, 0,3", "7.85e-9"), "ELASTIC of A is 210000,0, 0,3, must be 2 numbers"),
        (DECK.format("A", "210, 0.3", "7.85e-6"), "Young modulus of 210 is 2.1e.08 Pa with the unit mm"),
        (DECK.format("A", "1, 2", "3").replace("IC", "IC, TYPE=ENGINEERING CONSTANTS"), "not isotr"),
    ):
        (tmp_path / "m.inp").write_text(text)
        with pytest.raises(ValueError, match=said):
            deck.material(tmp_path / "m.inp", "mm")
