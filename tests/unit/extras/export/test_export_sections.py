import numpy as np
import pandas as pd
import pytest

from bladerub.blade.elasticity import Material, Solid
from bladerub.blade.geometry import BladeShape
from bladerub.blade.linear import lowest_modes
from bladerub.blade.mesh import BladeMesh
from bladerub.blade.rotation import equilibrium
from bladerub.config.read import load
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.origin import Source
from bladerub.extras.export.sections import write_sections
from bladerub.io.folders import ROOT

COUNTS = {"chordwise": 7, "thickness": 1, "spanwise": 6}


def frequencies(mesh, material):
    solid = Solid(mesh.mesh, Material.from_config(material), clamped=mesh.root)
    return lowest_modes(equilibrium(solid, 0.0).stiffness, solid.mass, 8)[0]


@pytest.mark.parametrize("coordinates", ["cartesian", "cylindrical"])
def test_the_default_blade_comes_back_from_its_sections_in_inches_and_degrees(tmp_path, coordinates):
    blade = load(ROOT / "config" / "config.yaml")["blade"]
    path = tmp_path / "blade.csv"
    write_sections(path, BladeShape.from_config(blade), coordinates)
    table = pd.read_csv(path, comment="#")
    lengths = [name for name in table if name not in ("section", "theta1", "theta2")]
    table[lengths] /= 0.0254
    if coordinates == "cylindrical":
        table[["theta1", "theta2"]] = np.rad2deg(table[["theta1", "theta2"]])
    table.to_csv(path, index=False)
    imported = import_blade(Source(path, Frame("inch"), angle_unit="deg"), COUNTS)
    ours = BladeMesh.from_shape(BladeShape.from_config(blade), COUNTS)
    found, expected = (frequencies(mesh, blade["material"]) for mesh in (imported.blade.mesh, ours))
    np.testing.assert_allclose(found, expected, rtol=3e-4)
    assert np.rad2deg(imported.blade.tip_cone) == pytest.approx(blade["tip_cone"], abs=1e-4)
    assert all(section.cut == (0, 0) for section in imported.sections)
    interface = imported.blade.mesh.mesh.points[imported.blade.mesh.interface]
    np.testing.assert_allclose(interface, ours.mesh.points[ours.interface], atol=1e-4)
