import itertools

import numpy as np
import pytest

from bladerub.extras.blades.frame import AXES, Frame
from bladerub.extras.file_units import UNITS

FRAMES = [
    Frame("m", rotation, downstream, radial)
    for rotation, downstream, radial in itertools.product(AXES, repeat=3)
    if downstream[-1] == rotation[-1] != radial[-1]
]


def vector(axis):
    return (-1.0 if axis.startswith("-") else 1.0) * np.eye(3)["xyz".index(axis[-1])]


def test_every_frame_is_turned_never_mirrored_and_rotation_increases_the_angle_of_the_blade():
    assert len(FRAMES) == 48
    for frame in FRAMES:
        assert np.linalg.det(frame.turn) == pytest.approx(1.0)
        radial, along = frame.metres(np.stack([vector(frame.radial), vector(frame.downstream)]))
        np.testing.assert_array_equal(radial, [0, 0, 1])
        np.testing.assert_array_equal(along, [frame.downstream_x, 0, 0])
        tip = vector(frame.radial)
        _, y, z = frame.metres(tip + 1e-3 * np.cross(vector(frame.rotation), tip))
        assert np.arctan2(y, z) == pytest.approx(1e-3, rel=1e-5)


def test_units_are_those_of_the_law():
    lengths = {unit: Frame(unit).metres(np.array([[0.0, 0.0, 1.0]]))[0, 2] for unit in UNITS}
    inch, foot = 0.0254, 0.3048
    assert lengths == {"m": 1.0, "mm": 0.001, "cm": 0.01, "inch": inch, "feet": foot, "in": inch, "ft": foot}


@pytest.mark.parametrize(
    ("axes", "said"),
    [
        ({"downstream": "y"}, "downstream = y: must be along the axis of rotation, x or -x"),
        ({"radial": "-x"}, "radial = -x: must not be the axis of rotation"),
    ],
)
def test_axes_that_do_not_go_together_are_refused(axes, said):
    with pytest.raises(ValueError, match=said):
        Frame(**axes)
