import numpy as np
import pytest
from scipy import sparse

from bladerub.blade import sparse_products
from bladerub.blade.sparse_products import Product


@pytest.fixture
def solid(make_block):
    return make_block(size=(0.02, 0.01, 0.3), counts=(1, 1, 6), origin=(0.01, 0.0, 0.3), clamp_bottom=True)


@pytest.fixture
def stiffness(solid):
    return solid.tangent(np.zeros(solid.free.size))


@pytest.fixture
def scipy_products(monkeypatch):
    """Count the products that are left to SciPy."""
    made = []
    product = sparse.csc_array.__matmul__
    monkeypatch.setattr(
        sparse.csc_array,
        "__matmul__",
        lambda matrix, other: made.append(other.shape) or product(matrix, other),
    )
    return made


@pytest.mark.parametrize("width", [1, 7, 8, 20])
@pytest.mark.parametrize("order", ["C", "F"])
def test_a_block_is_multiplied_node_by_node(stiffness, width, order, scipy_products):
    block = np.random.default_rng(width).standard_normal((stiffness.shape[0], width))
    expected = stiffness.toarray() @ block
    product = Product(stiffness)(np.asarray(block, order=order))
    np.testing.assert_allclose(product, expected, rtol=0, atol=1e-14 * np.abs(expected).max())
    assert not scipy_products


def test_the_number_of_threads_changes_no_bit(stiffness, monkeypatch):
    block = np.random.default_rng(0).standard_normal((stiffness.shape[0], 5))
    both = Product(stiffness)(block)
    for threads in (1, 3, stiffness.shape[0]):
        monkeypatch.setattr(sparse_products, "_THREADS", threads)
        np.testing.assert_array_equal(Product(stiffness)(block), both)


def test_rows_without_entries_are_zeros(stiffness, monkeypatch):
    none = sparse.csc_array((3, 3))
    padded = sparse.csc_array(sparse.block_diag([none, stiffness, none]))
    monkeypatch.setattr(sparse_products.np, "empty", lambda size: np.full(size, np.nan))
    product = Product(padded)(np.ones((padded.shape[0], 2)))
    np.testing.assert_array_equal(product[[0, 1, 2, -3, -2, -1]], 0)
    assert np.isfinite(product).all()


def test_a_vector_and_other_patterns_are_left_to_scipy(solid, stiffness, scipy_products):
    n = stiffness.shape[0]
    less_one = sparse.csc_array(stiffness[:-1][:, :-1])
    holed = stiffness.copy()
    holed.data[1] = 0
    holed.eliminate_zeros()
    mass = solid.mass  # as many entries in each row of a node, but not in the same columns
    for matrix, shape in ((stiffness, (n,)), (mass, (n, 2)), (less_one, (n - 1, 2)), (holed, (n, 2))):
        block = np.random.default_rng(0).standard_normal(shape)
        expected = matrix.toarray() @ block
        before = len(scipy_products)
        np.testing.assert_allclose(
            Product(matrix)(block), expected, rtol=0, atol=1e-14 * np.abs(expected).max()
        )
        assert len(scipy_products) == before + 1
