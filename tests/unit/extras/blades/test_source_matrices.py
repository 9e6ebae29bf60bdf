import re
import shutil
import subprocess
import sys
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
import pandas as pd
import pytest
from blade_parts import REDUCTION, TITANIUM, TWISTED
from scipy import sparse
from scipy.io import mmread, mmwrite

from bladerub.blade.build import build, reduce_given
from bladerub.blade.elasticity import Solid
from bladerub.blade.files import made_from
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.rotation import rotating_stiffness
from bladerub.extras.blades.matrices import check_definite, import_matrices
from bladerub.extras.blades.origin import check
from bladerub.extras.blades.report import matrix_report
from bladerub.extras.blades.settings import Source
from bladerub.extras.export.blade_files import write_fe_matrices
from bladerub.io.errors import BadInput
from bladerub.settings.blade import BladeSpec


@pytest.fixture
def config():
    blade, reduction = TWISTED.replaced("tip_cone", 9.0), REDUCTION.replaced("accuracy_speeds", 5)
    return BladeSpec(blade=blade, reduction=reduction)


@pytest.fixture
def folder(written, tmp_path):
    return Path(shutil.copytree(written, tmp_path / "matrices"))


def imported(folder, **source):
    return import_matrices(Source(matrices=str(folder), **source), REDUCTION)


def of_folder(config, folder):
    return config.replaced("blade.source", Source(matrices=str(folder)))


def edit(folder, name, change):
    path = folder / f"{name}.npz"
    sparse.save_npz(path, sparse.csc_array(change(sparse.load_npz(path))))


def edit_nodes(folder, change):
    change(pd.read_csv(folder / "nodes.csv")).to_csv(folder / "nodes.csv", index=False)


def test_the_blade_comes_back_from_its_matrices(config, discrete, tmp_path):
    paths = write_fe_matrices(tmp_path, discrete, 0.4, ".mtx")
    assert sorted(paths) == sorted(tmp_path.iterdir())
    ours, theirs = build(config), build(of_folder(config, tmp_path))
    np.testing.assert_allclose(theirs.frequency, ours.frequency, rtol=1e-9)
    np.testing.assert_allclose(theirs.accuracy, ours.accuracy, rtol=1e-8, atol=1e-8)
    blades = (ours.reduced, theirs.reduced)
    for f_omega in (0.0, 0.3):
        a, b = (reduced_frequencies(blade, f_omega, 8) for blade in blades)
        np.testing.assert_allclose(b, a, rtol=1e-8)
        square = (2 * np.pi * a[:2].mean()) ** 2  # of a vibration between the first modes
        a, b = (np.linalg.inv(blade.stiffness(f_omega) - square * blade.mass) for blade in blades)
        np.testing.assert_allclose(b[:24, :24], a[:24, :24], rtol=0, atol=1e-7 * abs(a[:24, :24]).max())
    for name in ("root", "tip", "interface"):
        np.testing.assert_array_equal(getattr(theirs.mesh, name), getattr(ours.mesh, name))
    for name in ("node_position", "radial_direction", "tangential_direction"):
        np.testing.assert_allclose(getattr(theirs.reduced, name), getattr(ours.reduced, name), atol=1e-12)
    assert theirs.mesh.mesh.cells.shape == (0, 20)
    assert theirs.static_displacement.shape == (0, len(ours.mesh.mesh.points), 3)


def test_rows_of_clamped_nodes_other_axes_and_units(discrete, tmp_path):
    """All rows, x along the blade, z upstream, in mm, t and N/mm, as other programs write them."""
    turn = np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]], dtype=float)  # rows: axes of the blade in the file
    mesh = discrete.layout.mesh
    solid = Solid(mesh.mesh, TITANIUM)
    everywhere = sparse.kron(sparse.eye_array(solid.n_nodes), turn)
    omega = 2 * np.pi * discrete.frequency[0] * np.array([0.0, 0.2, 0.4])
    displacement = [discrete.free.full(discrete.displacement[f_omega]).ravel() for f_omega in (0.0, 0.2, 0.4)]
    matrices = {"mass": solid.mass}
    for name, u, speed in zip(("rest", "half", "max"), displacement, omega, strict=True):
        matrices[f"stiffness_{name}"] = rotating_stiffness(solid, u, speed**2)
    for name, matrix in matrices.items():
        mmwrite(tmp_path / f"{name}.mtx", 1e-3 * (everywhere.T @ matrix @ everywhere), precision=17)
        content = (tmp_path / f"{name}.mtx").read_text()
        (tmp_path / f"{name}.mtx").write_text(re.sub(r"e([+-])", r"D\1", content))  # as Fortran writes
    nodes = pd.DataFrame(1e3 * mesh.mesh.points @ turn, columns=["x", "y", "z"])
    nodes["interface"] = pd.Series(range(1, 9), index=mesh.interface)  # empty elsewhere
    nodes["clamped"] = np.isin(np.arange(len(nodes)), mesh.root).astype(int)
    nodes.to_csv(tmp_path / "nodes.csv", index=False)

    frame = {"unit": "mm", "rotation": "z", "downstream": "-z", "radial": "x"}
    given = imported(tmp_path, **frame, matrix_units="mm-tonne", omega_max=float(omega[-1]))
    assert given.mass == pytest.approx(solid.mass.sum() / 3)
    assert given.mass_is_complete
    assert given.blade.layout.length == pytest.approx(0.2, rel=0.01)
    np.testing.assert_allclose(given.blade.frequency, discrete.frequency, rtol=1e-9)
    np.testing.assert_allclose(given.blade.layout.mesh.mesh.points, mesh.mesh.points, atol=1e-15)
    pairs = [(discrete.mass, given.blade.mass), (discrete.stiffness[0.4], given.blade.stiffness[0.4])]
    for ours, theirs in pairs:
        assert abs(theirs - ours).max() <= 1e-12 * abs(ours).max()


def report(folder, config, units="SI"):
    source = Source(matrices=str(folder), matrix_units=units)
    config = config.replaced("reduction.modes_per_speed", 6)
    given = import_matrices(source, config.reduction)
    return matrix_report(source, given, reduce_given(given.blade, config))


def test_figures_are_those_of_the_matrices_and_wrong_units_get_a_warning(folder, discrete, config):
    figures, mesh = report(folder, config), discrete.layout.mesh
    assert (figures["nodes"], figures["unknowns"]) == (len(mesh.mesh.points), discrete.mass.shape[0])
    f1 = discrete.frequency[0]
    assert (figures["f1_hz"], figures["omega_max"]) == pytest.approx((f1, 2 * np.pi * 0.4 * f1))
    assert figures["mass"] == pytest.approx(discrete.mass.sum() / 3)
    assert figures["interface"] == mesh.mesh.points[mesh.interface].tolist()
    assert figures["wave_speed"] == pytest.approx(6000, rel=0.05)
    assert figures["stiffness_half_way"] == pytest.approx(0.25, abs=0.03)
    assert 1e-6 < max(figures["error_eq2"]) < 0.01
    assert (figures["mass_is_whole"], figures["warnings"]) == (False, [])
    figures = report(folder, config, "mm-tonne")
    assert figures["f1_hz"] == pytest.approx(discrete.frequency[0])
    (wrong_units,) = figures["warnings"]
    assert wrong_units.endswith("are the matrices in mm-tonne, and the nodes in m?")


def test_another_speed_is_refused_and_nodes_without_clamped_ones_tell_no_length(folder, discrete, config):
    omega = 2 * np.pi * discrete.frequency[0] * 0.4
    imported(folder, omega_max=float(1.0009 * omega))
    with pytest.raises(BadInput, match=r"is 0.44 of the blade's first .*f_omega_max = 0.4 must be that"):
        imported(folder, omega_max=float(1.1 * omega))
    edit_nodes(folder, lambda nodes: nodes[nodes.clamped == 0].drop(columns="clamped"))
    given = imported(folder)
    assert not given.is_rooted
    assert not given.mass_is_complete
    assert 0.1 < given.blade.layout.length < 0.199
    assert build(of_folder(config, folder)).reduced.length == 0.2
    config = config.replaced("blade.length", 0.1)
    with pytest.raises(BadInput, match=r"blade.length = 0.1: must be that of the blade in .*/matrices"):
        build(of_folder(config, folder))


def test_a_blade_is_of_its_files_not_of_the_material(config, folder):
    ours = of_folder(config, folder)
    first = made_from(ours)
    assert made_from(ours.replaced("blade.material.density", 1000.0)) == first
    edit(folder, "mass", lambda mass: 2 * mass)
    assert made_from(ours) != first


def entry(folder, name, factor):
    content = sparse.load_npz(folder / f"{name}.npz").tolil()
    content[4, 6] *= factor
    edit(folder, name, lambda _: content)


def interface(folder, change):
    edit_nodes(folder, lambda nodes: nodes.assign(interface=change(nodes.interface)))


def text(folder, name, content):
    (folder / "mass.npz").unlink()
    (folder / name).write_text(content)


def offsets_that_go_back(folder):
    """Scipy reads the arrays of an archive without a look at them."""
    with np.load(folder / "mass.npz") as content:
        arrays = dict(content)
    arrays["indptr"][5] = 10**6
    np.savez_compressed(folder / "mass.npz", **arrays)


def bomb(folder):
    """An archive of a few hundred kB that unpacks to 1.2 GB."""
    with ZipFile(folder / "mass.npz", "a", ZIP_DEFLATED) as file, file.open("padding.npy", "w") as stream:
        for _ in range(1200):
            stream.write(bytes(10**6))


HEADER = "%%MatrixMarket matrix coordinate real general\n"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda at: (at / "stiffness_half.npz").unlink(), "matrices: holds no stiffness_half"),
        (lambda at: text(at, "mass.mtx", HEADER + "1 1 1\n1 1 2,0\n"), "mass.mtx: .*line 3 has ','"),
        (offsets_that_go_back, "mass.npz: is not a .npz file that can be read"),
        (bomb, "mass.npz: takes 1.2 GB of memory for 486 rows; must take 0.8 GB or less"),
        (lambda at: text(at, "blade.mas", "1 1 2.0e-03\n"), "holds no mass.mtx .*blade.mas of Calcul"),
        (lambda at: entry(at, "stiffness_half", np.nan), r"half.npz: its entry \(5, 7\) is nan"),
        (lambda at: entry(at, "stiffness_max", 1.01), r"max.npz: is not symm.*\((5, 7|7, 5)"),
        (lambda at: interface(at, lambda number: number.replace(3, 2)), "csv: 2 nodes have interface = 2"),
        (lambda at: interface(at, lambda number: (9 - number) * (number > 0)), "1 is downstream of node 8"),
        (lambda at: shutil.copy(at / "mass.npz", at / "stiffness_at_0.5.npz"), "0.5.npz: must be named"),
    ],
)
def test_broken_folders_are_refused_with_file_and_culprit(folder, change, said):
    change(folder)
    with pytest.raises(BadInput, match=said) as caught:
        imported(folder)
    assert str(caught.value).startswith(str(folder))


def test_keys_that_do_not_go_together_are_refused():
    with pytest.raises(ValueError, match=r"^file: missing"):
        check(Source())
    with pytest.raises(ValueError, match=r"^root_set = R: must not be given beside matrices"):
        check(Source(matrices="m", root_set="R"))


def test_one_negative_eigenvalue_among_many_is_found():
    n = 2000
    stiffness = sparse.diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=[-1, 0, 1])
    check_definite(sparse.csc_array(stiffness))
    stiffness = stiffness.tolil()
    stiffness[700, 701] = stiffness[701, 700] = -2.5
    with pytest.raises(ValueError, match="is not positive definite: it has negative eigenvalues"):
        check_definite(sparse.csc_array(stiffness))


PAGE = Path(__file__).parents[4] / "docs" / "how-to" / "bring_a_blade.md"
MATRIX = np.array([[2.0, 0.5, -1.0], [0.5, 3.0, 0.0], [-1.0, 0.0, 4.0]])
WRITTEN = {
    "abaqus.mtx": "** MASS\n7,1, 7,1, 2.0\n7,2, 7,1, 0.5\n7,2, 7,2, 3.0\n7,3, 7,1, -1.0\n7,3, 7,3, 4.0\n",
    "rows.mtx": "1 1 2.0\n1 2 0.5\n1 3 -1.0\n2 1 0.5\n2 2 3.0\n3 1 -1.0\n3 3 4.0\n",
    "blade.sti": "1 1 4.0\n1 2 -1.0\n2 2 2.0\n2 3 0.5\n3 3 3.0\n",  # rows z, x, y
}


@pytest.mark.parametrize("name", WRITTEN)
def test_matrices_of_other_programs_become_matrix_market(name, tmp_path):
    _, code = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (tmp_path / "convert.py").write_text(code)
    (tmp_path / name).write_text(WRITTEN[name])
    (tmp_path / "blade.dof").write_text("7.3\n7.1\n7.2\n")  # of blade.sti
    subprocess.run([sys.executable, "convert.py", name, "out.mtx"], cwd=tmp_path, check=True)
    np.testing.assert_array_equal(mmread(tmp_path / "out.mtx").toarray(), MATRIX)


ALL = ("mass", "stiffness_rest", "stiffness_half", "stiffness_max")


def of_nodes(order):
    return lambda n: (3 * order(np.arange(n))[:, None] + np.arange(3)).ravel()


@pytest.mark.parametrize(
    ("order", "names", "said"),
    [
        (lambda n: np.arange(3 * n).reshape(n, 3).T.ravel(), ALL, "mass.npz: .* all x, then all y"),
        (of_nodes(np.random.default_rng(0).permutation), ALL, "nodes.csv: must have the order of the mat"),
        (
            of_nodes(lambda n: np.r_[n[:-9], n[-2], n[-8:-2], n[-9], n[-1]]),
            ALL[3:],
            r"stiffness_max.npz: differs from .* at \d+ nodes \(rows",
        ),
    ],
)
def test_matrices_in_another_order_are_refused(folder, order, names, said):
    rows = order(sparse.load_npz(folder / "mass.npz").shape[0] // 3)
    for name in names:
        edit(folder, name, lambda matrix: matrix[rows][:, rows])
    with pytest.raises(BadInput, match=said):
        imported(folder)


def test_rounded_coordinates_and_lumped_mass_are_accepted_but_no_nodes_in_other_places(folder):
    table = pd.read_csv(folder / "nodes.csv").round({"x": 5, "y": 5, "z": 5})
    edit(folder, "mass", lambda mass: sparse.diags_array(mass.diagonal()))
    table.to_csv(folder / "nodes.csv", index=False)
    imported(folder)
    exchanged, mirrored = table.copy(), table.assign(y=table.y.where(table.index != 149, -table.y))
    places = ["x", "y", "z"]
    exchanged.loc[[149, 150], places] = table.loc[[150, 149], places].to_numpy()
    for changed, said in ((exchanged, "rows 150, 151: must be exchanged"), (mirrored, "row 150: must be in")):
        changed.to_csv(folder / "nodes.csv", index=False)
        with pytest.raises(BadInput, match=f"nodes.csv: {said}"):
            imported(folder)


@pytest.mark.parametrize("held", [(1.0, 1.0), (1.0, 1e-12), (1e20, 1e-12)])
def test_numbers_on_the_diagonal_of_clamped_rows(folder, discrete, held):
    """With ones dozens of modes at 1/2π Hz come first; a penalty puts them above all others."""
    is_held = np.repeat(pd.read_csv(folder / "nodes.csv").clamped.to_numpy() > 0, 3)
    edit_nodes(folder, lambda nodes: nodes.drop(columns="clamped"))
    for path in folder.glob("stiffness_at_*"):
        path.unlink()
    for name in ALL:
        full = sparse.lil_array((is_held.size, is_held.size))
        full[np.ix_(~is_held, ~is_held)] = sparse.load_npz(folder / f"{name}.npz").toarray()
        full[is_held, is_held] = held[name == "mass"]
        sparse.save_npz(folder / f"{name}.npz", full.tocsc())
    if held[0] > 1:
        assert imported(folder).blade.frequency[0] == pytest.approx(discrete.frequency[0], rel=1e-6)
    else:
        with pytest.raises(BadInput, match=rf"rest.npz: {is_held.sum()} coordinates are joined to no other"):
            imported(folder)


def test_a_blade_that_is_unstable_at_speed_or_that_nothing_holds_is_refused(folder, discrete):
    square = (2 * np.pi * discrete.frequency[:2].mean()) ** 2  # makes the first mode alone unstable
    edit(folder, "stiffness_max", lambda stiffness: stiffness - square * discrete.mass)
    with pytest.raises(BadInput, match=r"stiffness_max.npz: is not positive definite: a mode"):
        imported(folder)
    loose = Solid(discrete.layout.mesh.mesh, TITANIUM)
    edit(folder, "mass", lambda _: loose.mass)
    for path in folder.glob("stiffness_*"):
        edit(folder, path.stem, lambda _: loose.tangent(np.zeros(loose.free.size)))
    edit_nodes(folder, lambda nodes: nodes.drop(columns="clamped"))
    with pytest.raises(BadInput, match=r"rest.npz: is singular or indefinite: its lowest mode moves"):
        imported(folder)
