import dataclasses
import json
from dataclasses import replace

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
from bladerub.extras.blades.similarity import tip_stiffness, track_area
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
    coarse, place = sorted(figures["warnings"], reverse=True)
    assert place.startswith("an interface node is 4 mm from its place")
    assert coarse.startswith("its mesh is coarse, with 3 elements")


def of_matrices(folder, units):
    source = MatrixSource(folder, Frame(), units)
    imported = import_matrices(source, 0.4, 8, 6)
    config = CONFIG | {"reduction": CONFIG["reduction"] | {"accuracy_speeds": 5}}
    return matrix_report(source, imported, reduce_given(imported.blade, config))


def test_figures_are_those_of_the_matrices_and_wrong_units_get_a_warning(folder, discrete):
    figures, mesh = of_matrices(folder, "SI"), discrete.layout.mesh
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
    figures = of_matrices(folder, "mm-tonne")
    assert figures["f1_hz"] == pytest.approx(discrete.frequency[0])
    (wrong_units,) = figures["warnings"]
    assert wrong_units.endswith("are the matrices in mm-tonne, and the nodes in m?")


def test_stiffness_of_a_tip_on_equal_springs_and_track_area_of_even_nodes(blade):
    # a force F over 8 nodes moves each by F / (8 k): the softest of the three directions counts
    springs = np.concatenate([np.tile([3e6, 2e6, 5e6], 8), np.full(len(blade.mass) - 24, 1e9)])
    on_springs = replace(blade, stiffness_0=np.diag(springs))
    assert tip_stiffness(on_springs) == pytest.approx(8 * 2e6)
    x = np.linspace(0, 0.07, 8)
    on_a_circle = replace(blade, node_position=np.column_stack([x, np.zeros(8), np.full(8, 0.5)]))
    # strips of a seventh of the chord, half of one at the edges
    assert track_area(on_a_circle) == pytest.approx(2 * np.pi * 0.5 * 0.07 / 8)
