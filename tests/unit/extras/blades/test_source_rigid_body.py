"""Matrices whose order is not that of ``nodes.csv`` have right frequencies, and are refused."""

import numpy as np
import pandas as pd
import pytest
from scipy import sparse

from bladerub.extras.blades.matrices import import_matrices
from bladerub.extras.blades.origin import MatrixSource
from bladerub.io.errors import BadInput

STIFFNESS = ("stiffness_rest", "stiffness_half", "stiffness_max")
ALL = ("mass", *STIFFNESS)


def imported(folder):
    return import_matrices(MatrixSource(folder), 0.4, 8, 3)


def of_nodes(order):
    return lambda n: (3 * order(np.arange(n))[:, None] + np.arange(3)).ravel()


def exchange(nodes):
    nodes[[-2, -9]] = nodes[[-9, -2]]
    return nodes


@pytest.mark.parametrize(
    ("order", "names", "said"),
    [
        (
            lambda n: np.arange(3 * n).reshape(n, 3).T.ravel(),
            ALL,
            "mass.npz: .* all x, then all y",
        ),
        (
            of_nodes(np.random.default_rng(0).permutation),
            ALL,
            "nodes.csv: must have the order of the matrices",
        ),
        (of_nodes(exchange), STIFFNESS[2:], r"stiffness_max.npz: differs from .* at \d+ nodes \(rows"),
    ],
    ids=["by direction", "as a solver renumbers", "two nodes at the highest speed exchanged"],
)
def test_matrices_in_another_order_are_refused(folder, order, names, said):
    for path in (folder / f"{name}.npz" for name in names):
        matrix = sparse.load_npz(path)
        rows = order(matrix.shape[0] // 3)
        sparse.save_npz(path, sparse.csc_array(matrix[rows][:, rows]))
    with pytest.raises(BadInput, match=said):
        imported(folder)


@pytest.mark.parametrize(
    ("rows", "of", "sign", "said"),
    [
        ([149, 150], [150, 149], 1, "nodes.csv: rows 150, 151: must be exchanged"),
        ([149], [149], -1, "nodes.csv: row 150: must be in"),  # of y
    ],
)
def test_nodes_in_other_places_are_refused(folder, rows, of, sign, said):
    table = pd.read_csv(folder / "nodes.csv")
    table.loc[rows, ["x", "y", "z"]] = table.loc[of, ["x", "y", "z"]].to_numpy() * [1, sign, 1]
    table.to_csv(folder / "nodes.csv", index=False)
    with pytest.raises(BadInput, match=said):
        imported(folder)


def test_rounded_coordinates_lumped_mass_and_no_clamped_nodes_are_accepted(folder):
    """As other programs write them."""
    table = pd.read_csv(folder / "nodes.csv").round({"x": 5, "y": 5, "z": 5})
    mass = sparse.load_npz(folder / "mass.npz").diagonal()
    sparse.save_npz(folder / "mass.npz", sparse.diags_array(mass).tocsc())
    table.to_csv(folder / "nodes.csv", index=False)
    imported(folder)
    table[table.clamped == 0].drop(columns="clamped").to_csv(folder / "nodes.csv")
    imported(folder)


@pytest.mark.parametrize("held", [(1.0, 1.0), (1.0, 1e-12), (1e20, 1e-12)])
def test_numbers_on_the_diagonal_of_clamped_rows(folder, discrete, held):
    """With ones dozens of modes at 1/2π Hz come first; a penalty puts them above all others."""
    table = pd.read_csv(folder / "nodes.csv")
    is_held = np.repeat(table.clamped.to_numpy() > 0, 3)
    for path in folder.glob("stiffness_at_*"):
        path.unlink()
    for name in ALL:
        full = sparse.lil_array((is_held.size, is_held.size))
        full[np.ix_(~is_held, ~is_held)] = sparse.load_npz(folder / f"{name}.npz").toarray()
        full[is_held, is_held] = held[name == "mass"]
        sparse.save_npz(folder / f"{name}.npz", full.tocsc())
    table.drop(columns="clamped").to_csv(folder / "nodes.csv", index=False)
    if held[0] > 1:
        assert imported(folder).blade.frequency[0] == pytest.approx(discrete.frequency[0], rel=1e-6)
    else:
        said = rf"mass.npz and .*stiffness_rest.npz: {is_held.sum()} coordinates are joined to no other"
        with pytest.raises(BadInput, match=said):
            imported(folder)


def test_an_indefinite_stiffness_at_speed_is_refused(folder, discrete):
    path = folder / "stiffness_max.npz"
    square = (2 * np.pi * discrete.frequency[:2].mean()) ** 2  # makes the first mode alone unstable
    sparse.save_npz(path, sparse.csc_array(sparse.load_npz(path) - square * discrete.mass))
    with pytest.raises(BadInput, match=r"stiffness_max.npz: is not positive definite: a mode"):
        imported(folder)
