"""Passes of an elastic blade: the limit of a rigid one, momentum, energy, and what cannot be simulated."""

from dataclasses import replace

import numpy as np
import pytest

from bladerub import plugins
from bladerub.blade.tip import tip_radius
from bladerub.contact.setup import strip_width
from bladerub.contact.spec import PLASTIC
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.extras.rig import blade as elastic
from bladerub.extras.rig.passes import simulate_passes
from bladerub.extras.rig.spec import Rig
from bladerub.io.tables import described_columns

DAMPING = 2.3e-3
AS_RIGID = ["normal_impulse", "tangential_impulse", "normal_force", "tangential_force"]
AS_RIGID += ["worn_depth", "pass_wear", "pass_energy", "temperature_rise"]


@pytest.fixture
def rig(blade):
    return Rig(
        "a blade",
        E=600e6,
        K=300e6,
        yield_stress=1e5,
        thickness=3e-3,
        tip_width=float(strip_width(blade).sum()),
        tip_length=8e-3,
        track=2 * np.pi * tip_radius(blade),
        speed=150.0,
        incursion=1e-5,
        passes=3,
        theta=0.2,
        edge_drop=5e-6,
        coated=0.1,
    )


def passes(rig, blade, **options):
    return elastic.simulate_blade_passes(rig, blade, DAMPING, **options)


@pytest.mark.parametrize(
    "law", [PLASTIC, described_law("viscoplastic", {"viscosity": 1e4}), described_law("thermal", LAYER)]
)
def test_a_stiff_blade_is_a_rigid_tip(rig, blade, law):
    rig, stiff = replace(rig, law=law), replace(blade, stiffness_0=1e6 * blade.stiffness_0)
    rigid, made = simulate_passes(rig, elastic.ELEMENTS, elastic.STEPS), passes(rig, stiff)
    assert tuple(made.columns) == elastic.COLUMNS
    assert set(made.columns) <= described_columns(*plugins.files("columns.csv")).keys()
    for name in AS_RIGID:
        expected = pytest.approx(rigid[name].to_numpy(), rel=5e-3, nan_ok=True)
        assert made[name].to_numpy() == expected, name


def test_a_blade_yields_and_the_ledger_is_closed(rig, blade):
    rigid, made = simulate_passes(rig), passes(rig, blade)
    assert made.worn_depth[0] < 0.99 * rigid.worn_depth[0]
    assert (made.radial_amplitude > 1e-7).all()
    assert (made.energy_residual < 1e-3).all()
    assert (made.largest_normal_force <= made.largest_pressure * rig.tip_width * rig.tip_length).all()


def test_the_blade_keeps_the_impulse(rig, blade):
    # Uncoupled masses of 1 kg: what a short pass leaves of momentum, each bounces by v / ω
    blade = replace(blade, mass=np.eye(24), stiffness_0=(2 * np.pi * 100.0) ** 2 * np.eye(24), f1_hz=100.0)
    blade = replace(blade, stiffness_1=0 * blade.stiffness_0, stiffness_2=0 * blade.stiffness_0)
    rig = replace(rig, theta=0.0, passes=1, coated=0.02, edge_drop=0.0)
    made = passes(rig, blade).iloc[0]
    impulse = made.normal_impulse * strip_width(blade)[0] / rig.tip_width  # of node 1
    assert made.radial_amplitude == pytest.approx(impulse / (2 * np.pi * 100.0), rel=0.02)


def test_a_disk_that_turns_leaves_the_blade_its_stiffness_at_rest(rig, blade):
    at_rest = replace(blade, stiffness_1=0 * blade.stiffness_1, stiffness_2=0 * blade.stiffness_2)
    on_disk = passes(rig, blade, disk_turns=True)
    assert on_disk.equals(passes(rig, at_rest))
    assert not on_disk.equals(passes(rig, blade))
    faster = replace(rig, speed=600.0)
    assert passes(faster, blade, disk_turns=True).worn_depth.iloc[-1] > 0


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"coated": 3.9}, "coated = 3.9: must be above 0 and at most 3.6"),
        ({"incursion": 2e-3, "passes": 1, "E": 6e12, "K": 6e12}, "incursion: the tip of the blade moves by"),
    ],
)
def test_what_cannot_be_simulated_is_refused(rig, blade, change, problem):
    soft = replace(blade, stiffness_0=1e-4 * blade.stiffness_0) if "K" in change else blade
    with pytest.raises(ValueError, match=problem):
        passes(replace(rig, **change), soft)
