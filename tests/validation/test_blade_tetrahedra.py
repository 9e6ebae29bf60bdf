"""The default blade of tetrahedra, meshed by Gmsh and imported, against that of hexahedra.

Gmsh (Geuzaine and Remacle 2009, International Journal for Numerical Methods in Engineering 79:1309) meshes a
plate of the blade's length, chord and thickness; its nodes, those in the middle of edges as well, are then
put on the blade. The test needs the package `gmsh` from PyPI.
"""

import numpy as np
import pytest
from free_vibration import frequencies

from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.settings import Source

gmsh = pytest.importorskip("gmsh", reason="Gmsh (pip install gmsh) is not installed", exc_type=ImportError)

PLATE = np.array([0.082, 0.008, 0.2])  # m


def write_tetrahedra(path, shape, size):
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.MeshSizeMin", size)
        gmsh.option.setNumber("Mesh.MeshSizeMax", size)
        volume = gmsh.model.occ.addBox(0, 0, 0, *PLATE)
        gmsh.model.occ.synchronize()
        for name, height in (("root", 0.0), ("tip", PLATE[2])):
            box = np.add([[0.0, 0.0, height], [*PLATE[:2], height]], [[-1e-6], [1e-6]])
            faces = gmsh.model.getEntitiesInBoundingBox(*box.ravel(), 2)
            gmsh.model.addPhysicalGroup(2, [tag for _, tag in faces], name=name)
        gmsh.model.addPhysicalGroup(3, [volume], name="blade")
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        on_blade = shape.points(*np.clip(coordinates.reshape(-1, 3) / PLATE, 0, 1).T).T
        for tag, place in zip(tags, on_blade, strict=True):
            gmsh.model.mesh.setNode(tag, place, [])
        gmsh.write(str(path))
    finally:
        gmsh.finalize()


def test_eight_frequencies_are_those_of_hexahedra(paper_config, tmp_path):
    config = paper_config.blade
    shape = BladeShape.from_config(config)
    write_tetrahedra(tmp_path / "blade.msh", shape, 0.008)
    path = str(tmp_path / "blade.msh")
    imported = import_blade(Source(file=path, root_set="root", tip_set="tip"), config.mesh)
    by_rule = import_blade(Source(file=path), config.mesh).blade.mesh
    np.testing.assert_array_equal(by_rule.root, imported.blade.mesh.root)
    np.testing.assert_array_equal(by_rule.tip, imported.blade.mesh.tip)
    blades = (imported.blade.mesh, BladeMesh.from_shape(shape, config.mesh))
    tetrahedra, hexahedra = (frequencies(blade.mesh, blade.root, config.material) for blade in blades)
    difference = np.abs(tetrahedra / hexahedra - 1).max()
    print(f"{imported.blade.mesh.mesh.t.shape[1]} tetrahedra: largest difference {difference:.1e}")
    assert difference < 5e-3
