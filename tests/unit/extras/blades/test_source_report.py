import dataclasses
import json
import re

import numpy as np
import pytest

from bladerub.blade.build import meshed_blade, reduce_given, reduce_meshed
from bladerub.blade.discrete import by_finite_elements
from bladerub.blade.elasticity import Material
from bladerub.blade.geometry import BladeShape
from bladerub.blade.mesh import BladeMesh
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.matrices import import_matrices
from bladerub.extras.blades.origin import MatrixSource, Source
from bladerub.extras.blades.report import matrix_report, mesh_report
from bladerub.extras.export.matrices import write_fe_matrices
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


FINE = {
    "f_omega_max": 0.4,
    "modes_per_speed": 6,
    "rank_tolerance": 1e-6,
    "accuracy_speeds": 5,
    "accuracy_modes": 8,
}


@pytest.fixture
def reported_matrices(twisted_config, tmp_path):
    """Report on the twisted blade from its matrices, with changes to its source or to what was imported."""

    def make(frame=None, matrix_units="SI", n_speeds=5, **changes):
        config = {"blade": twisted_config, "reduction": FINE | {"accuracy_speeds": n_speeds}}
        speeds = np.linspace(0, 0.4, n_speeds).tolist()
        material = Material.from_config(twisted_config["material"])
        blade = by_finite_elements(meshed_blade(twisted_config), material, speeds, [], 8)
        write_fe_matrices(tmp_path, blade, 0.4, ".npz")
        source = MatrixSource(tmp_path, frame or Frame(), matrix_units)
        imported = dataclasses.replace(import_matrices(source, 0.4, 8, 6), **changes)
        return matrix_report(source, imported, reduce_given(imported.blade, config)), blade

    return make


def test_figures_are_those_of_the_matrices(reported_matrices):
    figures, blade = reported_matrices()
    assert json.loads(json.dumps(figures)) == figures
    assert figures["nodes"] == len(blade.layout.mesh.mesh.points)
    assert figures["unknowns"] == blade.mass.shape[0]
    assert figures["speeds"] == pytest.approx([0, 0.1, 0.2, 0.3, 0.4])
    assert figures["f1_hz"] == pytest.approx(blade.frequency[0])
    assert figures["omega_max"] == pytest.approx(2 * np.pi * 0.4 * blade.frequency[0])
    assert figures["mass"] == pytest.approx(blade.mass.sum() / 3)
    assert not figures["mass_is_whole"]
    assert figures["interface"] == blade.layout.mesh.mesh.points[blade.layout.mesh.interface].tolist()
    assert figures["wave_speed"] == pytest.approx(6000, rel=0.05)
    assert figures["stiffness_half_way"] == pytest.approx(0.25, abs=0.03)
    assert 1e-6 < max(figures["error_eq2"]) < 0.01
    assert figures["campbell_ratio"] > 1
    assert figures["warnings"] == []


@pytest.mark.parametrize("units", ["mm-tonne"])
def test_wrong_units_of_the_matrices_get_a_warning_though_the_frequencies_are_right(reported_matrices, units):
    figures, blade = reported_matrices(matrix_units=units)
    assert figures["f1_hz"] == pytest.approx(blade.frequency[0])
    (wrong_units,) = figures["warnings"]
    assert re.fullmatch(
        rf"its mass is .* kg in a box of .* are the matrices in {units}, and the nodes in m\?", wrong_units
    )
