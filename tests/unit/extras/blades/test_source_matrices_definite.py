import numpy as np
import pytest
from scipy import sparse

from bladerub.extras.blades.matrices import check_definite, check_held


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
