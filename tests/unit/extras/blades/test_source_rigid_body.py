"""Matrices whose order is not that of ``nodes.csv`` have right frequencies, and are refused."""

import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy import sparse
from test_source_matrices import discrete, written  # noqa: F401

from bladerub.extras.blades.matrices import import_matrices
from bladerub.extras.blades.origin import MatrixSource
from bladerub.io.errors import BadInput

STIFFNESS = ("stiffness_rest", "stiffness_half", "stiffness_max")
ALL = ("mass", *STIFFNESS)


@pytest.fixture
def folder(written, tmp_path):  # noqa: F811
    return Path(shutil.copytree(written, tmp_path / "matrices"))


def reorder(folder, order, names=ALL):
    for name in names:
        matrix = sparse.load_npz(folder / f"{name}.npz")
        n = matrix.shape[0] // 3
        sparse.save_npz(folder / f"{name}.npz", sparse.csc_array(matrix[order(n)][:, order(n)]))


def by_direction(n):
    return np.arange(3 * n).reshape(n, 3).T.ravel()


def renumbered(n):
    nodes = np.random.default_rng(0).permutation(n)
    return (3 * nodes[:, None] + np.arange(3)).ravel()


def two_nodes_exchanged(n):
    nodes = np.arange(n)
    nodes[[-2, -9]] = nodes[[-9, -2]]
    return (3 * nodes[:, None] + np.arange(3)).ravel()


def places(rows, of):
    """Give the nodes in `rows` (from 1) the places of the rows `of`."""

    def change(table):
        to, by = (np.asarray(which) - 1 for which in (rows, of))
        table.loc[to, ["x", "y", "z"]] = table.loc[by, ["x", "y", "z"]].to_numpy()
        return table

    return change


def misread(table):
    table.loc[149, "y"] *= -1
    return table


ORDERS = {
    "by direction": (by_direction, ALL, r"mass.npz: .* all x, then all y, then all z"),
    "as a solver renumbers": (renumbered, ALL, "nodes.csv: must have the order of the matrices: has the "),
    "two nodes at the highest speed exchanged": (
        two_nodes_exchanged,
        STIFFNESS[2:],
        r"stiffness_max.npz: differs from .* at \d+ nodes \(rows",
    ),
}

NODES = {
    "two neighbours": (places([150, 151], [151, 150]), r"nodes.csv: rows 150, 151: must be exchanged"),
    "one coordinate wrong": (misread, r"nodes.csv: row 150: must be in"),
}


def imported(folder):
    return import_matrices(MatrixSource(folder), 0.4, 8, 3)


@pytest.mark.parametrize("name", ORDERS)
def test_matrices_in_another_order_are_refused(folder, name):
    order, names, said = ORDERS[name]
    reorder(folder, order, names)
    with pytest.raises(BadInput, match=said):
        imported(folder)


@pytest.mark.parametrize("name", NODES)
def test_nodes_in_other_places_are_refused(folder, name):
    change, said = NODES[name]
    change(pd.read_csv(folder / "nodes.csv")).to_csv(folder / "nodes.csv", index=False)
    with pytest.raises(BadInput, match=said):
        imported(folder)


@pytest.mark.parametrize(
    "change",
    [
        lambda folder, table: table.round({"x": 5, "y": 5, "z": 5}).to_csv(folder / "nodes.csv", index=False),
        lambda folder, table: lump(folder),
        lambda folder, table: table[table.clamped == 0].drop(columns="clamped").to_csv(folder / "nodes.csv"),
    ],
    ids=["coordinates in 0.01 mm", "lumped mass", "no clamped nodes listed"],
)
def test_what_other_programs_write_is_accepted(folder, change):
    change(folder, pd.read_csv(folder / "nodes.csv"))
    imported(folder)


def lump(folder):
    mass = sparse.load_npz(folder / "mass.npz").diagonal().reshape(-1, 3)
    sparse.save_npz(folder / "mass.npz", sparse.diags_array(mass.ravel()).tocsc())


@pytest.mark.parametrize("held", [(1.0, 1.0), (1.0, 1e-12), (1e20, 1e-12)])
def test_numbers_on_the_diagonal_of_clamped_rows(folder, discrete, held):  # noqa: F811
    """With ones dozens of modes at 1/2π Hz come first; a penalty puts them above all others."""
    table = pd.read_csv(folder / "nodes.csv")
    is_held = np.repeat(table.clamped.to_numpy() > 0, 3)
    for path in folder.glob("stiffness_at_*"):
        path.unlink()
    for name in ALL:
        value = held[name == "mass"]
        full = sparse.lil_array((is_held.size, is_held.size))
        full[np.ix_(~is_held, ~is_held)] = sparse.load_npz(folder / f"{name}.npz").toarray()
        full[is_held, is_held] = value
        sparse.save_npz(folder / f"{name}.npz", full.tocsc())
    table.drop(columns="clamped").to_csv(folder / "nodes.csv", index=False)
    if held[0] > 1:
        assert imported(folder).blade.frequency[0] == pytest.approx(discrete.frequency[0], rel=1e-6)
    else:
        said = rf"mass.npz and .*stiffness_rest.npz: {is_held.sum()} coordinates are joined to no other"
        with pytest.raises(BadInput, match=said):
            imported(folder)


def test_an_indefinite_stiffness_at_speed_is_refused(folder, discrete):  # noqa: F811
    path = folder / "stiffness_max.npz"
    square = (2 * np.pi * discrete.frequency[:2].mean()) ** 2  # makes the first mode alone unstable
    sparse.save_npz(path, sparse.csc_array(sparse.load_npz(path) - square * discrete.mass))
    with pytest.raises(BadInput, match=r"stiffness_max.npz: is not positive definite: a mode"):
        imported(folder)
