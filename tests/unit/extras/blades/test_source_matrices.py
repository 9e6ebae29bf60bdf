import copy
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

from bladerub.blade.build import build, meshed_blade
from bladerub.blade.discrete import by_finite_elements
from bladerub.blade.elasticity import Material, Solid
from bladerub.blade.files import made_from
from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.rotation import rotating_stiffness
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.matrices import check_definite, check_held, import_matrices
from bladerub.extras.blades.origin import MatrixSource, read
from bladerub.extras.export.matrices import write_fe_matrices
from bladerub.io.errors import BadInput

FIVE_SPEEDS = REDUCTION | {"accuracy_speeds": 5}


BLADE = TWISTED | {"tip_cone": 9.0}


@pytest.fixture
def config():
    return copy.deepcopy({"blade": BLADE, "reduction": FIVE_SPEEDS})


@pytest.fixture(scope="module")
def discrete():
    speeds = np.linspace(0, 0.4, FIVE_SPEEDS["accuracy_speeds"]).tolist()
    material = Material.from_config(BLADE["material"])
    return by_finite_elements(meshed_blade(BLADE), material, speeds, [], REDUCTION["accuracy_modes"])


@pytest.fixture(scope="module")
def written(discrete, tmp_path_factory):
    folder = tmp_path_factory.mktemp("written")
    write_fe_matrices(folder, discrete, 0.4, ".npz")
    return folder


@pytest.fixture
def folder(written, tmp_path):
    """Matrices of the blade that a test may change."""
    return Path(shutil.copytree(written, tmp_path / "matrices"))


def imported(folder, **source):
    return import_matrices(MatrixSource(folder, **source), 0.4, 8, 3)


def of_folder(config, folder, **more):
    return config | {"blade": config["blade"] | {"source": {"matrices": str(folder), **more}}}


def test_the_blade_comes_back_from_its_matrices(config, discrete, tmp_path):
    paths = write_fe_matrices(tmp_path, discrete, 0.4, ".mtx")
    assert sorted(path.name for path in paths) == sorted(path.name for path in tmp_path.iterdir())
    ours, theirs = build(config), build(of_folder(config, tmp_path))
    np.testing.assert_allclose(theirs.frequency, ours.frequency, rtol=1e-9)
    np.testing.assert_allclose(theirs.accuracy, ours.accuracy, rtol=1e-8, atol=1e-8)
    for f_omega in (0.0, 0.3):
        a, b = (reduced_frequencies(blade.reduced, f_omega, 8) for blade in (ours, theirs))
        np.testing.assert_allclose(b, a, rtol=1e-8)
    for name in ("root", "tip", "interface"):
        np.testing.assert_array_equal(getattr(theirs.mesh, name), getattr(ours.mesh, name))
    for name in ("node_position", "radial_direction", "tangential_direction"):
        a, b = (getattr(blade.reduced, name) for blade in (ours, theirs))
        np.testing.assert_allclose(b, a, atol=1e-12)
    assert theirs.mesh.mesh.cells.shape == (0, 20)
    assert theirs.static_displacement.shape == (0, len(ours.mesh.mesh.points), 3)


def test_rows_of_clamped_nodes_other_axes_and_units(config, discrete, tmp_path):
    """All rows, x along the blade, z upstream, in mm, t and N/mm, as other programs write them."""
    turn = np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]], dtype=float)  # rows: axes of the blade in the file
    mesh = discrete.layout.mesh
    solid = Solid(mesh.mesh, Material.from_config(TITANIUM))
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

    frame = Frame("mm", rotation="z", downstream="-z", radial="x")
    given = imported(tmp_path, frame=frame, matrix_units="mm-tonne", omega_max=omega[-1])
    volume = solid.mass.sum() / 3 / TITANIUM["density"]
    assert given.mass == pytest.approx(TITANIUM["density"] * volume)
    assert given.mass_is_complete
    assert given.blade.layout.length == pytest.approx(0.2, rel=0.01)
    np.testing.assert_allclose(given.blade.frequency, discrete.frequency, rtol=1e-9)
    np.testing.assert_allclose(given.blade.layout.mesh.mesh.points, mesh.mesh.points, atol=1e-15)
    for ours, theirs in (
        (discrete.mass, given.blade.mass),
        (discrete.stiffness[0.4], given.blade.stiffness[0.4]),
    ):
        assert abs(theirs - ours).max() <= 1e-12 * abs(ours).max()


def test_nodes_without_clamped_ones_tell_no_length(config, folder):
    nodes = pd.read_csv(folder / "nodes.csv")
    nodes[nodes.clamped == 0].drop(columns="clamped").to_csv(folder / "nodes.csv", index=False)
    given = imported(folder)
    assert not given.is_rooted
    assert not given.mass_is_complete
    assert 0.1 < given.blade.layout.length < 0.199
    assert build(of_folder(config, folder)).reduced.length == 0.2
    for length in (0.1, 0.7):
        config["blade"]["length"] = length
        with pytest.raises(
            BadInput, match=rf"blade.length = {length}: must be that of the blade in .*/matrices"
        ):
            build(of_folder(config, folder))


def test_a_blade_that_nothing_holds_is_refused(discrete, folder):
    mesh = discrete.layout.mesh.mesh
    loose = Solid(mesh, Material.from_config(TITANIUM))
    sparse.save_npz(folder / "mass.npz", loose.mass)
    for path in folder.glob("stiffness_*"):
        sparse.save_npz(path, loose.tangent(np.zeros(loose.free.size)))
    nodes = pd.read_csv(folder / "nodes.csv")
    nodes.drop(columns="clamped").to_csv(folder / "nodes.csv", index=False)
    with pytest.raises(
        BadInput, match=r"stiffness_rest.npz: is singular or indefinite: its lowest mode moves"
    ):
        imported(folder)


def test_a_speed_that_is_not_the_configs_is_refused(folder, discrete):
    omega = 2 * np.pi * discrete.frequency[0] * 0.4
    assert imported(folder, omega_max=1.0009 * omega).blade.frequency[0] == pytest.approx(
        discrete.frequency[0]
    )
    with pytest.raises(BadInput, match=r"is 0.44 of the blade's first .*f_omega_max = 0.4 must be that"):
        imported(folder, omega_max=1.1 * omega)


def test_a_blade_is_of_its_files_not_of_the_material(config, folder):
    ours = of_folder(config, folder)
    first = made_from(ours)
    ours["blade"]["material"]["density"] = 1000.0
    assert made_from(ours) == first
    sparse.save_npz(folder / "mass.npz", 2 * sparse.load_npz(folder / "mass.npz"))
    assert made_from(ours) != first


def matrix(name, change):
    """Change the matrix `name` of a folder."""

    def apply(folder):
        path = folder / f"{name}.npz"
        sparse.save_npz(path, sparse.csc_array(change(sparse.load_npz(path).tolil())))

    return apply


def entry(row, column, value):
    def change(matrix):
        matrix[row, column] = value
        return matrix

    return change


def nodes(change):
    """Change the table of nodes of a folder."""

    def apply(folder):
        change(pd.read_csv(folder / "nodes.csv").astype(object)).to_csv(folder / "nodes.csv", index=False)

    return apply


def cell(row, column, value):
    def change(table):
        table.loc[row, column] = value
        return table

    return change


def text(name, content):
    def apply(folder):
        (folder / "mass.npz").unlink()
        (folder / name).write_text(content)

    return apply


def added(name, source="stiffness_half.npz"):
    return lambda folder: shutil.copy(folder / source, folder / name)


def archive(**changes):
    """Replace arrays of mass.npz, which scipy reads without a look at them."""

    def apply(folder):
        with np.load(folder / "mass.npz") as content:
            arrays = {name: changes.get(name, lambda array: array)(array) for name, array in content.items()}
        np.savez_compressed(folder / "mass.npz", **arrays)

    return apply


def bomb(folder):
    """An archive of a few hundred kB that unpacks to 1.2 GB."""
    with ZipFile(folder / "mass.npz", "a", ZIP_DEFLATED) as file, file.open("padding.npy", "w") as stream:
        for _ in range(1200):
            stream.write(bytes(10**6))


HEADER = "%%MatrixMarket matrix coordinate real"


INTERFACE = "interface node 1 is downstream of node 8; must be at the leading edge"


BROKEN = {
    "a missing file": (
        lambda folder: (folder / "stiffness_half.npz").unlink(),
        "matrices: holds no stiffness_half",
    ),
    "a cut file": (
        text("mass.mtx", f"{HEADER} general\n9 9 5\n1 1 2.0\n"),
        "mass.mtx: is not a .mtx file that",
    ),
    "decimal commas": (text("mass.mtx", f"{HEADER} general\n1 1 1\n1 1 2,0\n"), "mass.mtx: .*line 3 has ','"),
    "offsets that go back": (
        archive(indptr=lambda array: np.where(np.arange(array.size) == 5, 10**6, array)),
        "mass.npz: is not a .npz file that can be read",
    ),
    "a bomb": (bomb, "mass.npz: takes 1.2 GB of memory for 486 rows; must take 0.8 GB or less"),
    "of CalculiX": (
        text("blade.mas", "1 1 2.0e-03\n"),
        "holds no mass.mtx or mass.npz; .*blade.mas of Calcul",
    ),
    "NaN": (matrix("stiffness_half", entry(4, 6, np.nan)), r"half.npz: its entry \(5, 7\) is nan"),
    "not symmetric": (
        matrix("stiffness_max", lambda m: entry(4, 6, 1.01 * m[4, 6])(m)),
        r"stiffness_max.npz: is not symmetric: its entry \((5, 7|7, 5)\) is .* off its mirror image",
    ),
    "indefinite": (
        matrix("stiffness_rest", lambda m: m - 0.5 * sparse.diags_array(m.diagonal())),
        "rest.npz: is not positive definite: it has negative eigenvalues",
    ),
    "a number twice": (
        nodes(lambda table: cell(table.index[table.interface == 0][-1], "interface", 2)(table)),
        "nodes.csv: 2 nodes have interface = 2",
    ),
    "backwards": (
        nodes(lambda table: table.assign(interface=[9 - n if n else 0 for n in table.interface])),
        f"nodes.csv: {INTERFACE}",
    ),
    "a speed too high": (added("stiffness_at_0.5.npz"), "stiffness_at_0.5.npz: must be named after .* = 0.4"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_folders_are_refused_with_file_and_culprit(folder, name):
    apply, said = BROKEN[name]
    apply(folder)
    with pytest.raises(BadInput, match=said) as caught:
        imported(folder)
    assert str(caught.value).startswith(str(folder))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ({}, "file: missing; must be given, or matrices in its place"),
        ({"matrices": "m", "file": "blade.inp"}, "file = blade.inp: must not be given beside matrices"),
        ({"matrices": "m", "root_set": "R"}, "root_set = R: must not be given beside matrices"),
        ({"file": "blade.inp", "matrix_units": "SI"}, "matrix_units = SI: must not be given beside file"),
    ],
)
def test_keys_that_do_not_go_together_are_refused(source, said):
    with pytest.raises(ValueError, match=said):
        read(source)


def chain(n, held=True):
    """Stiffness of `n` masses in a row, each tied to the next, the first to the wall if `held`."""
    stiffness = sparse.diags_array(
        [-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=[-1, 0, 1]
    ).tolil()
    stiffness[-1, -1] = 1.0
    stiffness[0, 0] = 2.0 if held else 1.0
    return sparse.csc_array(stiffness)


def lowest_mode(stiffness):
    return np.linalg.eigh(stiffness.toarray())[1][:, 0]


@pytest.mark.parametrize("n", [2, 40, 2000])
def test_a_chain_on_a_wall_passes(n):
    check_definite(chain(n))
    if n < 1000:
        check_held(chain(n), lowest_mode(chain(n)))


def test_one_negative_eigenvalue_among_many_is_found():
    stiffness = chain(2000).tolil()
    stiffness[700, 701] = stiffness[701, 700] = -2.5
    with pytest.raises(ValueError, match="is not positive definite: it has negative eigenvalues"):
        check_definite(sparse.csc_array(stiffness))


def test_a_chain_without_wall_is_not_held():
    with pytest.raises(ValueError, match="is singular or indefinite"):
        check_held(chain(40, held=False), lowest_mode(chain(40, held=False)))


PAGE = Path(__file__).parents[4] / "docs" / "how-to" / "bring_matrices.md"


MATRIX = np.array([[2.0, 0.5, -1.0], [0.5, 3.0, 0.0], [-1.0, 0.0, 4.0]])


WRITTEN = {
    "abaqus.mtx": "** MASS\n7,1, 7,1, 2.0\n7,2, 7,1, 0.5\n7,2, 7,2, 3.0\n7,3, 7,1, -1.0\n7,3, 7,3, 4.0\n",
    "rows.mtx": "1 1 2.0\n1 2 0.5\n1 3 -1.0\n2 1 0.5\n2 2 3.0\n3 1 -1.0\n3 3 4.0\n",
    "blade.sti": "1 1 4.0\n1 2 -1.0\n2 2 2.0\n2 3 0.5\n3 3 3.0\n",  # rows z, x, y
}


@pytest.mark.parametrize("name", WRITTEN)
def test_matrices_of_other_programs_become_matrix_market(name, tmp_path):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (tmp_path / "convert.py").write_text(code)
    (tmp_path / name).write_text(WRITTEN[name])
    if name == "blade.sti":
        (tmp_path / "blade.dof").write_text("7.3\n7.1\n7.2\n")
    subprocess.run([sys.executable, "convert.py", name, "out.mtx"], cwd=tmp_path, check=True)
    np.testing.assert_array_equal(mmread(tmp_path / "out.mtx").toarray(), MATRIX)
