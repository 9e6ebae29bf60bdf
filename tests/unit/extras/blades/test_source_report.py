import dataclasses
import json
import re

import pytest

from bladerub.blade.build import reduce_meshed
from bladerub.blade.elasticity import Material
from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.origin import Source
from bladerub.extras.blades.report import mesh_report
from bladerub.extras.export.mesh_file import write_mesh_file

REDUCTION = {
    "f_omega_max": 0.4,
    "modes_per_speed": 6,
    "rank_tolerance": 1e-6,
    "accuracy_speeds": 3,
    "accuracy_modes": 8,
}


@pytest.fixture
def reported(twisted_config, tmp_path):
    """Report on the twisted blade in a file, with changes to its sections, frame or what was imported."""

    def make(frame=None, of_shape=None, counts=None, **changes):
        if of_shape:
            twisted_config["sections"] = of_shape
        shape = BladeShape.from_config(twisted_config)
        blade = BladeMesh.from_shape(shape, counts or twisted_config["mesh"])
        path = tmp_path / "blade.vtu"
        write_mesh_file(path, blade.mesh.points, blade.mesh.cells, {"root": blade.root})
        source = Source(path, frame or Frame())
        imported = dataclasses.replace(import_blade(source, {}), **changes)
        config = {"blade": twisted_config, "reduction": REDUCTION}
        built = reduce_meshed(imported.blade, config)
        return mesh_report(source, imported, built, Material.from_config(twisted_config["material"])), built

    return make


def test_figures_are_those_of_the_blade(reported):
    figures, built = reported()
    assert json.loads(json.dumps(figures)) == figures
    assert figures["unknowns"] == 3 * (figures["nodes"] - built.mesh.root.size)
    assert figures["mass"] == pytest.approx(4430.0 * figures["volume"])
    assert figures["extents"]["radius"] == pytest.approx([0.45, 0.65])
    assert figures["f1_hz"] == built.frequency[0]
    first = built.accuracy[built.accuracy["mode"] == 1].f_fe.to_numpy()
    assert figures["campbell_ratio"] == first[-1] / first[0] > 1
    assert len(figures["error_eq2"]) == len(figures["error_reduced_model"]) == 8
    assert max(figures["error_eq2"]) < 1e-6  # the three speeds are those of the fit
    assert figures["error_reduced_model"][0] < 1e-3
    assert figures["elements_root_to_tip"] == 3
    (coarse,) = figures["warnings"]
    assert re.match("its mesh is coarse, with 3 elements", coarse)


def test_what_is_odd_about_a_mesh_gets_a_warning(reported):
    figures, _ = reported(interface_offset=0.004)
    assert any(line.startswith("an interface node is 4 mm from its place") for line in figures["warnings"])
