import numpy as np

from bladerub.contact.illustration import LoadingCycle
from bladerub.contact.spec import Coating
from bladerub.extras.plots.law_cycles import law_cycles

COATING = Coating(2.0, 0.5, 0.0, 0.0, modulus_unit=6e8, thickness=5e-3, n_elements=2000)


def cycle(stress):
    strain = np.array([0.0, 0.01, 0.02])
    return LoadingCycle(COATING, strain, np.asarray(stress), np.zeros(3))


def test_each_law_has_a_panel_with_its_cycles_in_megapascals(draws):
    panels = {
        "(a) one": {"soft": cycle([0, 0.01, 0.01])},
        "(b) two": {"slow": cycle([0, 0, 0.01]), "fast": cycle([0, 0.01, 0.02])},
    }
    first, second = draws(law_cycles(panels)).axes
    slow, fast = second.lines
    np.testing.assert_allclose(fast.get_xydata(), [[0, 0], [1, 6], [2, 12]])
    np.testing.assert_allclose(slow.get_ydata(), [0, 0, 6])
    assert first.get_ylim()[0] == 0
