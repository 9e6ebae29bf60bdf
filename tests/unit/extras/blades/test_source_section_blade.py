import dataclasses

import numpy as np
import pytest
from blade_parts import REDUCTION, TITANIUM
from section_parts import CHORD, LENGTH, THICKNESS, cartesian, cylindrical, in_space, lens, twisted_plate

from bladerub.blade.build import build
from bladerub.blade.elasticity import Material, Solid
from bladerub.blade.files import made_from
from bladerub.blade.geometry import lattice
from bladerub.blade.linear import lowest_modes
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.rotation import equilibrium
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.origin import Source
from bladerub.extras.blades.section_profile import EDGE_SHARE
from bladerub.io.errors import BadInput

COUNTS = {"chordwise": 7, "thickness": 1, "spanwise": 6}


def cylindrical_in_degrees(solid, **counts):
    table = cylindrical(solid, **counts)
    return table.assign(theta1=np.rad2deg(-table.theta1), theta2=np.rad2deg(-table.theta2))


FORMS = pytest.mark.parametrize(
    ("make", "angle_unit"), [(cartesian, None), (cylindrical_in_degrees, "deg")], ids=["points", "angles"]
)


@pytest.fixture
def read(tmp_path):
    """Import a table: what comes out."""

    def blade(table, frame=None, counts=COUNTS, name="blade.csv", **source):
        table.to_csv(tmp_path / name, index=False)
        return import_blade(Source(tmp_path / name, frame or Frame(), **source), counts)

    return blade


def frequencies(mesh, root):
    solid = Solid(mesh, Material.from_config(TITANIUM), clamped=root)
    return lowest_modes(equilibrium(solid, 0.0).stiffness, solid.mass, 8)[0]


@FORMS
def test_a_twisted_plate_is_that_of_its_formula(read, make, angle_unit):
    imported = read(make(twisted_plate), angle_unit=angle_unit)
    direct, (_, _, zeta) = hexahedral_mesh(*lattice(COUNTS), in_space(twisted_plate))
    mesh = imported.blade.mesh
    assert imported.volume == pytest.approx(CHORD * THICKNESS * LENGTH, rel=1e-4)
    np.testing.assert_allclose(
        frequencies(mesh.mesh, mesh.root), frequencies(direct, np.flatnonzero(zeta == 0)), rtol=2e-4
    )
    assert imported.blade.length == pytest.approx(LENGTH, rel=1e-9)
    assert imported.blade.tip_cone == pytest.approx(0, abs=1e-9)
    assert all(section.cut == (0, 0) for section in imported.sections)


@FORMS
def test_sharp_edges_are_cut_where_they_become_too_thin(read, make, angle_unit):
    imported = read(make(lens), angle_unit=angle_unit)
    start = (1 - np.sqrt(1 - EDGE_SHARE)) / 2  # where 4 ξ (1 - ξ) is the share
    lost = 2 * (2 * start**2 - 4 / 3 * start**3)
    for section in imported.sections:
        assert section.cut == pytest.approx((start * CHORD, start * CHORD), rel=0.05)
        assert section.thickness == pytest.approx(THICKNESS, rel=1e-3)
    assert imported.volume == pytest.approx((2 / 3 - lost) * CHORD * THICKNESS * LENGTH, rel=2e-3)


@pytest.mark.parametrize(
    ("frame", "sign_of_z", "sign_of_theta"),
    [
        (Frame("inch", rotation="z", downstream="-z", radial="x"), -1, 1),
        (Frame("inch", rotation="-z", downstream="z", radial="-y"), 1, -1),
        (Frame("inch"), 1, -1),
    ],
)
def test_angles_turn_by_the_right_hand_about_the_positive_axis(read, frame, sign_of_z, sign_of_theta):
    table = cylindrical(twisted_plate)
    angles = np.rad2deg(sign_of_theta * table[["theta1", "theta2"]])
    given = table.assign(z=sign_of_z * table.z / 0.0254, r=table.r / 0.0254, **angles)
    mesh = read(given, frame, angle_unit="deg").blade.mesh
    ours = read(table.assign(theta1=-table.theta1, theta2=-table.theta2)).blade.mesh
    np.testing.assert_allclose(mesh.mesh.points, ours.mesh.points, atol=1e-12)


def test_a_blade_whose_flow_is_along_its_rotation_vector_has_its_leading_edge_there(read):
    imported = read(cylindrical(twisted_plate), Frame(rotation="x", downstream="x"))
    mesh = imported.blade.mesh
    leading, trailing = mesh.mesh.points[mesh.interface[[0, -1]]]
    assert leading[0] > trailing[0]  # x of the blade's frame points against the rotation vector
    assert imported.volume == pytest.approx(CHORD * THICKNESS * LENGTH, rel=1e-4)


def raised(table, section, z):
    """Move the stations of a section outwards."""
    z = np.where(table.section == section, z, 0.0)
    return table.assign(z1=table.z1 + z, z2=table.z2 + z)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t[::-1], "section s8 .line 2.: its first station lies downstream of its last"),
        (
            lambda t: t.assign(x1=t.x1 - 0.02 * (t.index == 30), x2=t.x2 - 0.02 * (t.index == 30)),
            "without line 32 all do, so check its numbers",
        ),
        (lambda t: t.assign(x2=t.x1, y2=t.y1, z2=t.z1), "the sides of section s0 touch or cross here"),
        (lambda t: raised(t, "s4", 1.5 * t.x1), "sections s3 and s4 cross: s4 is not the farther from"),
    ],
)
def test_sections_that_make_no_blade_are_refused_with_file_and_culprit(read, change, said):
    with pytest.raises(BadInput, match=said) as caught:
        read(change(cartesian(twisted_plate)))
    assert "blade.csv: " in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_blade_of_sections_is_of_its_table_and_its_mesh(blade_config, tmp_path):
    path = tmp_path / "blade.csv"
    cartesian(twisted_plate).to_csv(path, index=False)
    config = {"blade": blade_config | {"source": {"file": str(path)}}, "reduction": {}}
    first = made_from(config)
    config["blade"]["hub_radius"] = 1.0
    assert made_from(config) == first
    config["blade"]["mesh"] = COUNTS
    assert made_from(config) != first
    path.write_text(path.read_text() + "# another\n")
    assert len({first, made_from(config)}) == 2


def test_a_blade_is_built_from_its_sections(blade_config, tmp_path, read):
    imported = read(cartesian(twisted_plate), counts=blade_config["mesh"])
    assert dataclasses.asdict(imported)["node_sets"] == {}
    source = {"file": str(tmp_path / "blade.csv")}
    built = build({"blade": blade_config | {"source": source}, "reduction": REDUCTION})
    np.testing.assert_array_equal(built.mesh.mesh.points, imported.blade.mesh.mesh.points)
    assert built.accuracy.relative_error.abs()[0] < 1e-3
