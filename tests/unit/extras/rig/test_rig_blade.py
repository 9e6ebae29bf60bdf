import math
from dataclasses import replace

import numpy as np
import pytest
import yaml

from bladerub.config.errors import ConfigError
from bladerub.contact.spec import PLASTIC
from bladerub.contact.strips import strip_width
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.extras.plots.studies import rigs as draw
from bladerub.extras.rig import blade as elastic
from bladerub.extras.rig.passes import compared, simulate_passes, table
from bladerub.extras.rig.spec import MEASURABLE, PLAN, Rig, read_rigs
from bladerub.io.folders import ROOT

TIP = {"tip_width": 1e-2, "tip_length": 2e-3, "track": 1.0, "speed": 125.0, "incursion": 1e-4}
RIG = Rig("bench", E=1.2e9, K=0.3e9, yield_stress=9e6, thickness=3e-3, **TIP)


def last(rig, **fineness):
    return simulate_passes(rig, **fineness).iloc[-1]


def test_theta_turns_the_force_impulses_are_over_the_coated_part_and_viscosity_resists_speed():
    whole, turned, part = last(RIG), last(replace(RIG, theta=0.3)), last(replace(RIG, coated=0.1))
    assert turned.normal_force == pytest.approx(math.cos(0.3) * whole.normal_force)
    by_wear = whole.tangential_force  # θ has no part in it
    assert turned.tangential_force == pytest.approx(math.sin(0.3) * whole.normal_force + by_wear)
    assert whole.normal_impulse == pytest.approx(whole.normal_force / 125.0)
    assert part.normal_impulse == pytest.approx(0.1 * whole.normal_impulse)
    assert part.pass_energy == pytest.approx(0.1 * whole.pass_energy)
    viscous = replace(RIG, edge_drop=4e-5, law=described_law("viscoplastic", {"viscosity": 1e4}))
    slow, fast = (last(replace(viscous, speed=speed)).normal_force for speed in (1e-3, 125.0))
    assert slow == pytest.approx(last(replace(RIG, edge_drop=4e-5)).normal_force, rel=1e-3)
    assert fast > 1.02 * slow


def test_a_constant_feed_gives_a_constant_force_without_lasting_hardening_and_warms_what_heats():
    law = described_law("brittle", {"break_strain": 0.004})
    fed = replace(RIG, yield_stress=0.0, incursion=1e-6, passes=120)
    hardening, steady = simulate_passes(fed), simulate_passes(replace(fed, law=law))
    assert hardening.normal_force[119] > 1.15 * hardening.normal_force[99]
    assert steady.normal_force[119] == pytest.approx(steady.normal_force[99])
    assert steady.pass_wear[119] == pytest.approx(1e-6)  # all that it is fed
    hot = replace(RIG, incursion=1e-6, passes=60, theta=0.3, law=described_law("thermal", LAYER))
    passes, cold = simulate_passes(hot), simulate_passes(replace(hot, law=RIG.law))
    assert passes.temperature_rise.iloc[0] == 0
    assert np.all(np.diff(passes.temperature_rise) > 0)
    assert np.all(cold.temperature_rise.isna())
    assert np.all(passes.normal_force[1:] < cold.normal_force[1:])
    np.testing.assert_allclose(passes.worn_depth, cold.worn_depth)  # E and K fall alike


def test_a_rounded_tip_converges_with_the_elements_and_its_energy_to_second_order_with_the_steps():
    forces = [last(replace(RIG, edge_drop=4e-5), elements=n).normal_force for n in (10, 20, 40, 80)]
    changes = np.abs(np.diff(forces))
    assert np.all(changes[1:] < 0.5 * changes[:-1])
    assert changes[-1] < 1e-3 * forces[-1]
    rounded = replace(RIG, edge_drop=9e-5, incursion=5e-5, passes=2)
    coarse, fine = (last(rounded, steps=n).energy_residual for n in (8, 32))
    assert fine < coarse / 8
    assert coarse < 1e-3


AS_RIGID = ["normal_impulse", "tangential_impulse", "normal_force", "tangential_force"]
AS_RIGID += ["worn_depth", "pass_wear", "pass_energy", "temperature_rise"]


@pytest.fixture
def rig(blade):
    tip = {"tip_width": float(strip_width(blade).sum()), "tip_length": 8e-3, "edge_drop": 5e-6}
    track = {"track": 2 * np.pi * blade.tip_radius, "speed": 150.0, "incursion": 1e-5, "coated": 0.1}
    return Rig("a blade", 600e6, 300e6, 1e5, 3e-3, passes=3, theta=0.2, **tip, **track)


def passes(rig, blade, **options):
    return elastic.simulate_blade_passes(rig, blade, damping_ratio=2.3e-3, **options)


@pytest.mark.parametrize(
    "law", [PLASTIC, described_law("viscoplastic", {"viscosity": 1e4}), described_law("thermal", LAYER)]
)
def test_a_stiff_blade_is_a_rigid_tip(rig, blade, law):
    rig, stiff = replace(rig, law=law), replace(blade, stiffness_0=1e6 * blade.stiffness_0)
    rigid, made = simulate_passes(rig, elastic.ELEMENTS, elastic.STEPS), passes(rig, stiff)
    assert tuple(made.columns) == elastic.COLUMNS
    np.testing.assert_allclose(made[AS_RIGID], rigid[AS_RIGID], rtol=5e-3)


def test_a_blade_yields_and_the_ledger_is_closed(rig, blade):
    rigid, made = simulate_passes(rig), passes(rig, blade)
    assert made.worn_depth[0] < 0.99 * rigid.worn_depth[0]
    assert (made.radial_amplitude > 1e-7).all()
    assert (made.energy_residual < 1e-3).all()
    assert (made.largest_normal_force <= made.largest_pressure * rig.tip_width * rig.tip_length).all()
    at_rest = replace(blade, stiffness_1=0 * blade.stiffness_1, stiffness_2=0 * blade.stiffness_2)
    on_disk = passes(rig, blade, disk_turns=True)
    assert on_disk.equals(passes(rig, at_rest))
    assert not on_disk.equals(passes(rig, blade))
    assert passes(replace(rig, speed=600.0), blade, disk_turns=True).worn_depth.iloc[-1] > 0


def test_the_blade_keeps_the_impulse(rig, blade):
    # Uncoupled masses of 1 kg: what a short pass leaves of momentum, each bounces by v / ω
    blade = replace(blade, mass=np.eye(24), stiffness_0=(2 * np.pi * 100.0) ** 2 * np.eye(24), f1_hz=100.0)
    blade = replace(blade, stiffness_1=0 * blade.stiffness_0, stiffness_2=0 * blade.stiffness_0)
    rig = replace(rig, theta=0.0, passes=1, coated=0.02, edge_drop=0.0)
    made = passes(rig, blade).iloc[0]
    impulse = made.normal_impulse * strip_width(blade)[0] / rig.tip_width  # of node 1
    assert made.radial_amplitude == pytest.approx(impulse / (2 * np.pi * 100.0), rel=0.02)


def test_what_cannot_be_simulated_is_refused(rig, blade):
    with pytest.raises(ValueError, match=r"coated = 3.9: must be above 0 and at most 3.6"):
        passes(replace(rig, coated=3.9), blade)
    hard, soft = replace(rig, incursion=2e-3, passes=1, E=6e12, K=6e12), 1e-4 * blade.stiffness_0
    with pytest.raises(ValueError, match="incursion: the tip of the blade moves by"):
        passes(hard, replace(blade, stiffness_0=soft))
    with pytest.raises(ValueError, match=r"tip_length = 0.5: must be at most the track, 0.4"):
        replace(RIG, tip_length=0.5, track=0.4)


def rigs(folder, **changes):
    """Read the rigs of the repository with few passes and these changes of the first one."""
    plan = yaml.safe_load((ROOT / PLAN).read_text(encoding="utf-8"))
    for rig in plan["rigs"].values():
        rig["passes"] = min(rig["passes"], 3)
    next(iter(plan["rigs"].values())).update(changes)
    (folder / "rigs.yaml").write_text(yaml.safe_dump(plan, sort_keys=False), encoding="utf-8")
    return read_rigs(folder / "rigs.yaml")


def test_what_was_measured_stands_beside_what_is_computed_and_a_problem_has_file_and_key(tmp_path):
    found = rigs(tmp_path, measured={"normal_force": 50.0, "worn_depth": 9e-5})
    passes = table(found)
    assert passes.rig.value_counts().to_dict() == {"spindle": 3, "sintered_seal": 3, "ballistic_bench": 1}
    assert passes.element_law[1].startswith("thermal (")
    beside = compared(found, passes)
    assert len(beside) == 3 * len(MEASURABLE)
    first = beside[beside.rig == "ballistic_bench"].set_index("quantity")
    assert first.measured_on_rig["normal_force"] == 50.0
    assert np.isnan(first.measured_on_rig["pass_energy"])
    assert first.computed["normal_force"] == passes.normal_force[0]
    assert [50.0] in [line.get_ydata().tolist() for line in draw(passes, beside).axes[0].lines]
    with pytest.raises(ConfigError, match=r"rigs.yaml:\d+: rigs.ballistic_bench.incursion = 0.005: must be"):
        rigs(tmp_path, incursion=5e-3)
