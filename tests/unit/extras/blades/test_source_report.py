import dataclasses
import json

import numpy as np
import pytest
from blade_parts import REDUCTION, TITANIUM, TWISTED

from bladerub.blade.build import meshed_blade, reduce_given, reduce_meshed
from bladerub.blade.elasticity import Material
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.matrices import import_matrices
from bladerub.extras.blades.origin import MatrixSource, Source
from bladerub.extras.blades.report import matrix_report, mesh_report
from bladerub.extras.export.mesh_file import write_mesh_file

CONFIG = {"blade": TWISTED, "reduction": REDUCTION | {"modes_per_speed": 6, "rank_tolerance": 1e-6}}


def test_figures_are_those_of_the_mesh_and_what_is_odd_gets_a_warning(tmp_path):
    blade, source = meshed_blade(TWISTED).mesh, Source(tmp_path / "blade.vtu", Frame())
    write_mesh_file(source.file, blade.mesh.points, blade.mesh.cells, {"root": blade.root})
    imported = dataclasses.replace(import_blade(source, {}), interface_offset=0.004)
    built = reduce_meshed(imported.blade, CONFIG)
    figures = mesh_report(source, imported, built, Material.from_config(TITANIUM))
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
    warnings = sorted(figures["warnings"])
    assert warnings[0].startswith("an interface node is 4 mm from its place")
    assert warnings[1].startswith("its mesh is coarse, with 3 elements")
    assert len(warnings) == 2


@pytest.fixture
def of_matrices(folder):
    """Report on the matrices."""

    def make(units):
        source = MatrixSource(folder, Frame(), units)
        imported = import_matrices(source, 0.4, 8, 6)
        config = CONFIG | {"reduction": CONFIG["reduction"] | {"accuracy_speeds": 5}}
        return matrix_report(source, imported, reduce_given(imported.blade, config))

    return make


def test_figures_are_those_of_the_matrices(of_matrices, discrete):
    figures, mesh = of_matrices("SI"), discrete.layout.mesh
    assert json.loads(json.dumps(figures)) == figures
    assert figures["nodes"] == len(mesh.mesh.points)
    assert figures["unknowns"] == discrete.mass.shape[0]
    assert figures["speeds"] == pytest.approx([0, 0.1, 0.2, 0.3, 0.4])
    assert figures["f1_hz"] == pytest.approx(discrete.frequency[0])
    assert figures["omega_max"] == pytest.approx(2 * np.pi * 0.4 * discrete.frequency[0])
    assert figures["mass"] == pytest.approx(discrete.mass.sum() / 3)
    assert not figures["mass_is_whole"]
    assert figures["interface"] == mesh.mesh.points[mesh.interface].tolist()
    assert figures["wave_speed"] == pytest.approx(6000, rel=0.05)
    assert figures["stiffness_half_way"] == pytest.approx(0.25, abs=0.03)
    assert 1e-6 < max(figures["error_eq2"]) < 0.01
    assert figures["campbell_ratio"] > 1
    assert figures["warnings"] == []


def test_wrong_units_of_the_matrices_get_a_warning_though_the_frequencies_are_right(of_matrices, discrete):
    figures = of_matrices("mm-tonne")
    assert figures["f1_hz"] == pytest.approx(discrete.frequency[0])
    (wrong_units,) = figures["warnings"]
    assert wrong_units.endswith("are the matrices in mm-tonne, and the nodes in m?")
