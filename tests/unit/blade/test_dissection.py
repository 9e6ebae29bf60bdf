import numpy as np
import pytest
from scipy import sparse
from scipy.sparse.linalg import splu

from bladerub.blade.dissection import nested_dissection


@pytest.fixture(scope="module")
def block():
    """Stiffness of a cube of nodes with three unknowns each, joined to their neighbours."""
    n = 9
    line = sparse.diags_array([np.full(n, 2.0), -np.ones(n - 1), -np.ones(n - 1)], offsets=[0, 1, -1])
    eye = sparse.eye_array(n)
    nodes = sum(
        sparse.kron(sparse.kron(*(pair[:2])), pair[2])
        for pair in ((line, eye, eye), (eye, line, eye), (eye, eye, line))
    )
    return sparse.csc_array(sparse.kron(nodes, np.eye(3) + 0.1))


def test_every_unknown_comes_once_and_those_of_a_node_together(block):
    order = nested_dissection(block)
    np.testing.assert_array_equal(np.sort(order), np.arange(block.shape[0]))
    nodes = (order // 3).reshape(-1, 3)
    assert (nodes == nodes[:, :1]).all()


def test_the_factors_are_sparser_than_in_the_given_order(block):
    def entries(matrix):
        return splu(
            sparse.csc_matrix(matrix),
            permc_spec="NATURAL",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        ).nnz

    order = nested_dissection(block)
    assert entries(block[order][:, order]) < 0.6 * entries(block)


def test_the_same_order_every_time(block):
    np.testing.assert_array_equal(nested_dissection(block), nested_dissection(block))
