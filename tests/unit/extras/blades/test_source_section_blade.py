from contextlib import nullcontext

import numpy as np
import pandas as pd
import pytest
from blade_parts import REDUCTION, TITANIUM
from free_vibration import frequencies

from bladerub.blade.build import build
from bladerub.blade.files import made_from
from bladerub.blade.geometry import lattice
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.extras.blades import section_table, sections
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.origin import Frame
from bladerub.extras.blades.sections import EDGE_SHARE
from bladerub.extras.blades.settings import Source
from bladerub.io.errors import BadInput
from bladerub.settings.blade import BladeSpec, Mesh

CM = Frame("cm")
HUB, LENGTH, CHORD, THICKNESS = 0.45, 0.2, 0.08, 0.006
COUNTS = Mesh(chordwise=7, thickness=1, spanwise=6)


def in_space(x, radius, phi):
    return np.stack(np.broadcast_arrays(x, radius * np.sin(phi), radius * np.cos(phi)))


def twisted_plate(xi, eta, zeta):
    """A plate of constant thickness, wrapped on cylinders and twisted."""
    along, across = CHORD * (xi - 0.5), THICKNESS * (eta - 0.5)
    stagger = 0.5 + 0.6 * zeta
    radius = HUB + LENGTH * zeta
    x = along * np.cos(stagger) + across * np.sin(stagger)
    arc = -along * np.sin(stagger) + across * np.cos(stagger)
    return in_space(x, radius, arc / radius)


def lens(xi, eta, zeta):
    """A straight one with sharp edges, both sides parabolas, in the direction of the axis."""
    radius = HUB + LENGTH * zeta
    arc = THICKNESS * (eta - 0.5) * 4 * xi * (1 - xi)
    return in_space(CHORD * (xi - 0.5), radius, arc / radius)


def cartesian(solid, n_sections=9, n_stations=21):
    """Table of points of the surface; each section has two stations more than the one before."""
    parts = []
    for number, zeta in enumerate(np.linspace(0, 1, n_sections)):
        xi = np.linspace(0, 1, n_stations + 2 * number)
        sides = np.vstack([solid(xi, side, zeta) for side in (0.0, 1.0)])
        part = pd.DataFrame(sides.T, columns=["x1", "y1", "z1", "x2", "y2", "z2"])
        part.insert(0, "section", f"s{number}")
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


@pytest.fixture
def read(tmp_path):
    def blade(table, **axes):
        table.to_csv(tmp_path / "blade.csv", index=False)
        return import_blade(Source(file=str(tmp_path / "blade.csv"), **axes), COUNTS)

    return blade


def test_a_twisted_plate_is_that_of_its_formula(read):
    imported = read(cartesian(twisted_plate))
    direct, (_, _, zeta) = hexahedral_mesh(*lattice(COUNTS), twisted_plate)
    mesh = imported.blade.mesh
    assert imported.volume == pytest.approx(CHORD * THICKNESS * LENGTH, rel=1e-4)
    expected = frequencies(direct, np.flatnonzero(zeta == 0), TITANIUM)
    np.testing.assert_allclose(frequencies(mesh.mesh, mesh.root, TITANIUM), expected, rtol=2e-4)
    assert imported.blade.length == pytest.approx(LENGTH, rel=1e-9)
    assert imported.blade.tip_cone == pytest.approx(0, abs=1e-9)
    assert all(section.cut == (0, 0) for section in imported.sections)
    mesh = read(cartesian(twisted_plate), rotation="x", downstream="x").blade.mesh
    leading, trailing = mesh.mesh.points[mesh.interface[[0, -1]]]
    assert leading[0] > trailing[0]  # x of the blade's frame points against the rotation vector


def test_sharp_edges_are_cut_where_they_become_too_thin(read):
    imported = read(cartesian(lens))
    start = (1 - np.sqrt(1 - EDGE_SHARE)) / 2  # where 4 ξ (1 - ξ) is the share
    lost = 2 * (2 * start**2 - 4 / 3 * start**3)
    for section in imported.sections:
        assert section.cut == pytest.approx((start * CHORD, start * CHORD), rel=0.05)
        assert section.thickness == pytest.approx(THICKNESS, rel=1e-3)
    assert imported.volume == pytest.approx((2 / 3 - lost) * CHORD * THICKNESS * LENGTH, rel=2e-3)


def raised(table, section, z):
    z = np.where(table.section == section, z, 0.0)
    return table.assign(z1=table.z1 + z, z2=table.z2 + z)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t[::-1], "section s8 .line 2.: its first station lies downstream of its last"),
        (lambda t: t.assign(**t[["x1", "x2"]].sub(0.02 * (t.index == 30), axis=0)), "line 32: this st"),
        (lambda t: t.assign(x2=t.x1, y2=t.y1, z2=t.z1), "the sides of section s0 touch or cross here"),
        (lambda t: raised(t, "s4", 1.5 * t.x1), "sections s3 and s4 cross: s4 is not the farther from"),
    ],
)
def test_sections_that_make_no_blade_are_refused_with_file_and_culprit(read, change, said):
    with pytest.raises(BadInput, match=said) as caught:
        read(change(cartesian(twisted_plate)))
    assert "blade.csv: " in str(caught.value)


def test_a_blade_is_built_from_its_sections_and_is_of_its_table_and_its_mesh(blade_config, tmp_path, read):
    path = tmp_path / "blade.csv"
    cartesian(twisted_plate).to_csv(path, index=False)
    config = BladeSpec(blade=blade_config, reduction=REDUCTION)
    config = config.replaced("blade.source", Source(file=str(path)))
    first = made_from(config)
    assert made_from(config.replaced("blade.hub_radius", 1.0)) == first
    config = config.replaced("blade.mesh", COUNTS)
    assert made_from(config) != first
    path.write_text(path.read_text() + "# another\n")
    assert len({first, made_from(config)}) == 2
    imported = read(cartesian(twisted_plate))
    built = build(config)
    np.testing.assert_array_equal(built.mesh.mesh.points, imported.blade.mesh.mesh.points)
    assert built.accuracy.relative_error.abs()[0] < 1e-3


COMMAS = """# a plate
Section, Z, r, Theta1, THETA2, remark
hub end, 0, 40, 0.0, 0.0, nose
hub end, 1, 40, -0.01, 0.01,
hub end, 2, 40.5, -0.02, 0.01,   # the thickest

hub end, 3, 41, -0.01, 0.01,
hub end, 4, 41, 0, 0,
tip, 0, 60, 0, 0, nose
tip, 1, 60, -0.01, 0.01,
tip, 2, 60, -0.02, 0.01,
tip, 3, 60, -0.01, 0.01,
tip, 4, 60, 0, 0,
"""
SPACES = COMMAS.replace("hub end", "1").replace("tip", "2").replace(" nose", "").replace(", remark", "")
SPACES = SPACES.replace(",   # the", ",  # the").replace(",\n", "\n").replace(", ", "   ").replace(",", "")


def test_angles_in_another_unit_make_a_film_which_is_refused(tmp_path):
    (tmp_path / "film.csv").write_text(COMMAS.replace("0.02", "0.01"))
    for unit in ("rad", "deg"):
        source = Source(file=str(tmp_path / "film.csv"), unit="cm", angle_unit=unit)
        with pytest.raises(ValueError, match="mm thick over a chord") if unit == "deg" else nullcontext():
            sections.read_profiles(source)


@pytest.fixture
def table(tmp_path):
    def sections(text, angle_unit="rad", name="blade.csv", frame=CM):
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return section_table.read(tmp_path / name, frame, angle_unit)

    return sections


def test_stations_are_read_with_their_lines_and_as_well_after_a_byte_order_mark_and_with_spaces(table):
    hub, tip = table(COMMAS)
    assert (hub.name, tip.name) == ("hub end", "tip")
    assert hub.lines.tolist() == [3, 4, 5, 7, 8]
    assert hub.points.shape == (2, 5, 3)
    x, y, z = hub.points[0, 2]
    assert x == pytest.approx(0.02)
    assert np.hypot(y, z) == pytest.approx(0.405)
    assert np.arctan2(y, z) == pytest.approx(0.02)  # the blade turns about -x, angles about x
    for name in ("blade.txt", "BLADE.DAT"):
        of_spaces = table(b"\xef\xbb\xbf" + SPACES.encode(), name=name)
        for ours, theirs in zip((hub, tip), of_spaces, strict=True):
            np.testing.assert_array_equal(ours.points, theirs.points)


def test_angles_turn_by_the_right_hand_about_the_positive_axis_and_what_is_no_table_is_refused(table):
    stations, found = np.array([(z, 40.0 + z, 0.01 * z, 0.03 * z) for z in range(5)] * 2), []
    one, other = Frame("cm", rotation="z", downstream="-z", radial="x"), Frame("cm", "-z", "z", "-y")
    for factors, unit, frame in (
        ([1, 1, 1, 1], "rad", CM),
        ([-1, 1, *2 * [np.rad2deg(-1)]], "deg", one),
        ([1, 1, *2 * [np.rad2deg(1)]], "deg", other),
    ):
        rows = zip("aaaaabbbbb", stations * factors, strict=True)
        text = "".join(f"{name},{','.join(map(str, row))}\n" for name, row in rows)
        found.append(table("section,z,r,theta1,theta2\n" + text, unit, frame=frame)[0].points)
    np.testing.assert_allclose(found, found[:1] * 3, atol=1e-12)
    for text, said in (
        (COMMAS.replace("2, 40.5,", "2, ,"), "line 5: r = nothing, must be a finite number"),
        (COMMAS + COMMAS[COMMAS.index("hub") : COMMAS.index("tip")], "line 14: section hub end comes back"),
        (COMMAS.replace("0.01", "10"), "section hub end .* over 20 rad, .* are they in rad"),
    ):
        with pytest.raises(ValueError, match=said):
            table(text)
