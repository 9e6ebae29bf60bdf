"""A rotor as it was published: NASA Rotor 37, sections on surfaces that are no cylinders, with round edges.

The table and its origin: ``rotor37_sections.dat``. It has no frequencies; what can be checked is that
the solid is that of the table.
"""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.interpolate import PchipInterpolator

from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.importing import import_blade
from bladerub.extras.blades.origin import Source

FILE = Path(__file__).parent / "rotor37_sections.dat"


@pytest.fixture(scope="module")
def table():
    return pd.read_csv(FILE, comment="#", sep=r"\s+").rename(columns=str.lower)


@pytest.fixture(scope="module")
def imported():
    return import_blade(Source(FILE, Frame("cm")), {"chordwise": 14, "thickness": 2, "spanwise": 20})


def test_only_the_tips_of_the_round_edges_are_cut(imported):
    for section in imported.sections:
        assert 0 < min(section.cut) <= max(section.cut) < 0.005 * section.chord
    assert imported.jacobian_ratio.min() > 0.3


def test_areas_of_the_sections_are_those_of_the_table(imported, table):
    for profile, (_, rows) in zip(imported.sections, table.groupby("section"), strict=True):
        x, radius, phi = np.moveaxis(np.vstack([profile.samples[:, 0], profile.samples[::-1, 1]]), -1, 0)
        arc = radius * phi
        ours = np.sum(np.roll(x, -1) * arc - x * np.roll(arc, -1)) / 2  # of the polygon
        width = PchipInterpolator(rows.z, rows.r * (rows.theta1 - rows.theta2))
        theirs = 1e-4 * width.integrate(rows.z.min(), rows.z.max())
        assert abs(ours) == pytest.approx(theirs, rel=2e-3)


def test_volume_is_the_integral_of_the_areas(imported, table):
    # dV = r dθ dz dr: area of a section times its distance to the next, which changes along the chord
    radius, heights = [], np.linspace(0.0, 1.0, 101)
    for _, rows in table.groupby("section"):
        share = (rows.z - rows.z.iloc[0]) / (rows.z.iloc[-1] - rows.z.iloc[0])
        width = rows.r * (rows.theta1 - rows.theta2) * (rows.z.iloc[-1] - rows.z.iloc[0])
        radius.append([np.interp(heights, share, column) for column in (rows.r, width)])
    radius, width = np.moveaxis(np.array(radius) * [[[1e-2], [1e-4]]], 1, 0)
    # by a parabola or cubic through the four sections, as areas change smoothly with the radius
    strips = [
        np.polynomial.Polynomial.fit(radius[:, at], width[:, at], 3).integ() for at in range(heights.size)
    ]
    volumes = [strip(radius[-1, at]) - strip(radius[0, at]) for at, strip in enumerate(strips)]
    assert imported.volume == pytest.approx(np.trapezoid(volumes, heights), rel=0.01)
    assert imported.blade.length == pytest.approx((radius[-1] - radius[0]).mean(), rel=0.01)
