import dataclasses

import contact_in_numpy
import numpy as np
import pytest
import scipy.linalg
from study_fixtures import changed

from bladerub.contact.modes import modes_at
from bladerub.contact.run import simulate
from bladerub.contact.schemes import SCHEMES
from bladerub.contact.strips import element_area
from bladerub.extras.rows import study
from bladerub.extras.rows.row import coupled_frequencies, simulate_row
from bladerub.extras.rows.spec import Disk, Row, RowBlade
from bladerub.study.grid import run_spec
from bladerub.study.plan import longer_run, planned_run
from bladerub.study.solver import row_of


@pytest.fixture
def spec(spec, change):
    """Two lobes, that the blades of a row of two pass at the same time; neighbours stand far apart."""
    casing = dataclasses.replace(spec.casing, nodal_diameters=(2,), weights=(1.0,), start_angle=np.pi / 2)
    return dataclasses.replace(change(spec, n_elements=400), casing=casing)


def assert_same(one, other):
    for name in ("radial_displacement", "revolution_peak", "revolution_amplitude", "wear"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


@pytest.mark.parametrize(
    "changed",
    [{}, {"turns": True}, {"scheme": "central_differences", "max_time_step": 1e-6}, {"law": "coulomb"}],
)
def test_a_row_of_one_is_the_single_run_to_the_last_bit(blade, spec, change, changed):
    if "turns" in changed:
        blade = dataclasses.replace(blade, tip_slope=np.full((8, len(blade.mass)), -3.0))
    spec = change(spec, **changed)
    alone = simulate(blade, spec)
    row = simulate_row(blade, spec, Row.even(1))
    assert alone.n_contact_steps > 100
    assert_same(alone, row.blades[0])
    assert alone.energy == row.blades[0].energy == row.energy
    assert (row.status, row.message, row.unbounded) == (alone.status, alone.message, ())


def test_a_blade_that_reaches_nothing_leaves_the_other_alone_and_one_that_would_overlap_is_held(blade, spec):
    row, alone = simulate_row(blade, spec, Row.even(2, length=[-5e-3, 0.0])), simulate(blade, spec)
    assert not np.any(row.blades[0].radial_displacement)
    assert row.worn_volume[0] == 0 < row.worn_volume[1]
    # the other passes the same lobes half a turn further on
    half, within = spec.coating.n_elements // 2, 1e-9 * alone.revolution_peak.max()
    reaching = row.blades[1]
    np.testing.assert_allclose(reaching.radial_displacement, alone.radial_displacement, atol=within)
    np.testing.assert_allclose(reaching.wear, np.roll(alone.wear, half, axis=1), atol=1e-12)
    row = simulate_row(blade, spec, Row.even(4))
    quarter = spec.coating.n_elements // 4
    for number, each in enumerate(row.blades):
        held = quarter // 4 if number % 2 else 1  # else the gap closes on it within the first passages
        assert not np.any(each.radial_displacement[:held])
        assert each.status == "completed"


def test_neither_order_nor_numbering_changes_anything(blade, spec):
    blades = [RowBlade(0.0, 2e-5, 0.01), RowBlade(1.7, -1e-5, -0.02, 0.5), RowBlade(3.5, 0.0, 0.0, 2.0)]
    row = simulate_row(blade, spec, Row(tuple(blades)))
    for order in ([1, 2, 0], [2, 1, 0]):
        again = simulate_row(blade, spec, Row(tuple(blades[at] for at in order)))
        for place, at in enumerate(order):
            assert_same(again.blades[place], row.blades[at])
        np.testing.assert_array_equal(again.worn_volume, row.worn_volume[order])


def of_plain_model(blade, spec, row_of, row):
    one = row.blades[0]
    assert all(each.n_modes == one.n_modes for each in row.blades)
    histories, wear = contact_in_numpy.simulate_row(blade, spec, row_of, one.n_steps, one.n_modes)
    n = spec.coating.n_elements
    return [contact_in_numpy.element_means(history[:, 0], n) for history in histories], wear


LONG = [pytest.param(scheme, False, marks=pytest.mark.nightly) for scheme in SCHEMES]


@pytest.mark.parametrize(("scheme", "turns"), [("exponential", True), *LONG])
def test_blades_wear_one_coating_as_in_the_plain_model(blade, spec, change, scheme, turns):
    row_of = Row((RowBlade(0.0, 0.0, 0.01), RowBlade(3.3, 3e-5, (-0.02, 0.03), 2.0)))
    blade = dataclasses.replace(blade, tip_slope=np.full((8, len(blade.mass)), -3.0))
    spec = change(spec, scheme=scheme, turns=turns, max_time_step=1e-3, revolutions=1)
    row = simulate_row(blade, spec, row_of)
    displacements, wear = of_plain_model(blade, spec, row_of, row)
    for ours, expected in zip(row.blades, displacements, strict=True):
        within = 2e-6 * np.abs(expected).max()
        np.testing.assert_allclose(ours.radial_displacement, expected, rtol=0, atol=within)
    np.testing.assert_allclose(row.wear, wear, rtol=0, atol=2e-6 * wear.max())


def test_a_disk_couples_the_blades_as_in_the_plain_model(blade, spec, change):
    """The disk acts in every step there, in the loop once an element: the error is that of the splitting."""
    spec = change(spec, max_time_step=1e-3, revolutions=1)
    row_of = Row.even(2, length=[0.0, 2e-5], frequency=[0.0, 0.01], disk=Disk.ring(2, [0.05, 0.02]))
    row, apart_from_disk = simulate_row(blade, spec, row_of), simulate_row(blade, spec, Row(row_of.blades))
    displacements, wear = of_plain_model(blade, spec, row_of, row)
    for ours, apart, expected in zip(row.blades, apart_from_disk.blades, displacements, strict=True):
        error = np.abs(ours.radial_displacement - expected).max()
        effect = np.abs(ours.radial_displacement - apart.radial_displacement).max()
        assert error < 2e-4 * effect  # 9e-5 measured
    np.testing.assert_allclose(row.wear, wear, rtol=0, atol=1e-3 * wear.max())


def test_a_disk_moves_no_blade_that_is_held(blade, spec):
    spec = dataclasses.replace(spec, initial_displacement=2e-5)
    for each in simulate_row(blade, spec, Row.even(3, disk=Disk.ring(3, [0.2]))).blades:
        first = np.flatnonzero(each.radial_displacement)[:2]  # the last one is let go after 82 elements
        np.testing.assert_allclose(each.radial_displacement[first], 2e-5, rtol=5e-3)


def test_coupled_frequencies_are_those_of_the_cyclic_closed_form_and_of_the_whole_row(blade):
    n_blades, coupling, f_omega = 7, [0.05, 0.003], 0.3
    row, modes = Row.even(n_blades, disk=Disk.ring(n_blades, coupling)), modes_at(blade, f_omega)
    for mode, (c, matrix) in enumerate(zip(coupling, row.disk.stiffness, strict=True)):
        found = coupled_frequencies(modes, row, mode, np.array(matrix))
        sine = np.sin(np.pi * np.arange(n_blades) / n_blades)
        closed_form = modes.omega[mode] * np.sqrt(1 + 4 * c * sine**2)
        np.testing.assert_allclose(found, np.sort(closed_form), rtol=1e-9)
    n_blades, f_omega, rng = 5, 0.3, np.random.default_rng(1)
    scatter, springs = 0.02 * rng.standard_normal((n_blades, 2)), rng.random((2, n_blades, n_blades))
    matrices = [0.01 * (of.T @ of) for of in springs]
    row = Row.even(n_blades, frequency=scatter, disk=Disk.of(matrices))
    squares, modes = scipy.linalg.eigh(blade.stiffness(f_omega), blade.mass)
    forces = blade.mass @ modes  # per unit of a modal force
    stiffness = np.kron(np.eye(n_blades), blade.stiffness(f_omega))
    for mode, matrix in enumerate(matrices):
        own = np.diag((1 + scatter[:, mode]) ** 2 - 1)
        stiffness += squares[mode] * np.kron(own + matrix, np.outer(forces[:, mode], forces[:, mode]))
    whole = scipy.linalg.eigh(stiffness, np.kron(np.eye(n_blades), blade.mass), eigvals_only=True)
    modes_of_blade = modes_at(blade, f_omega)
    found = [coupled_frequencies(modes_of_blade, row, *of_mode) for of_mode in enumerate(matrices)]
    np.testing.assert_allclose(np.sort(found, axis=None), np.sqrt(whole[: 2 * n_blades]), rtol=1e-9)


def test_the_ledger_closes_with_the_disk_in_it_and_the_volumes_sum_up(blade, spec, change):
    blade = dataclasses.replace(blade, tip_slope=np.full((8, len(blade.mass)), -3.0))
    spec = change(spec, turns=True)
    row_of = Row.even(4, length=[0.0, 2e-5, 0.0, -3e-5], disk=Disk.ring(4, [0.1]))
    row = simulate_row(blade, spec, row_of)
    assert np.abs(row.disk_work).max() > 5e-4 * row.energy.exchanged
    assert row.residual < 1e-3
    exchanged = row.energy.exchanged
    assert abs(row.disk_work.sum() + row.disk_energy) < 1e-5 * exchanged
    for each, work in zip(row.blades, row.disk_work, strict=True):
        own = each.energy
        taken = own.kinetic + own.elastic - own.initial + own.damping
        supplied = own.work_radial + own.work_tangential + own.work_couple + work
        assert abs(supplied - taken) < 1e-9 * exchanged
    assert row.energy.wear == pytest.approx(sum(each.energy.wear for each in row.blades))
    volume = element_area(blade, spec) @ row.wear.sum(axis=1)
    np.testing.assert_allclose(row.worn_volume.sum(), volume, rtol=1e-9)


def test_a_run_ends_for_all_when_one_leaves_the_limit_and_is_the_same_until_then(blade, spec):
    row = Row.even(3, length=[1e-5, 0.0, -5e-3])
    whole = simulate_row(blade, spec, row)
    peaks = np.array([np.abs(each.radial_displacement) for each in whole.blades])
    tight = simulate_row(blade, dataclasses.replace(spec, displacement_limit=0.8 * peaks.max()), row)
    assert tight.status == "unbounded"
    assert tight.message.startswith(f"blade {tight.unbounded[0]}: the tip moved by more than")
    made = [np.isfinite(each.radial_displacement) for each in tight.blades]
    assert np.ptp([each.sum() for each in made]) <= 1
    assert tight.blades[2].status == "stopped"
    for ended, is_made, each in zip(tight.blades, made, whole.blades, strict=True):
        expected = np.where(is_made, each.radial_displacement, np.nan)
        np.testing.assert_allclose(ended.radial_displacement, expected, rtol=0, atol=1e-9 * peaks.max())


def test_the_amplitudes_of_a_row_that_ends_early_are_those_of_its_last_whole_revolutions(
    blade, spec, config, case, change, monkeypatch
):
    row, spec = Row.even(2), change(spec, revolutions=4)
    whole = simulate_row(blade, spec, row)
    made = np.arange(4 * spec.coating.n_elements) < 2.5 * spec.coating.n_elements
    ended = (
        dataclasses.replace(
            each,
            status="unbounded",
            radial_displacement=np.where(made, each.radial_displacement, np.nan),
            revolution_peak=np.append(each.revolution_peak[:3], np.nan),
            revolution_amplitude=np.append(each.revolution_amplitude[:2], [np.nan, np.nan]),
        )
        for each in whole.blades
    )
    early = dataclasses.replace(whole, status="unbounded", blades=tuple(ended), unbounded=(1, 2))
    monkeypatch.setattr("bladerub.extras.rows.row.simulate_row", lambda *arguments: early)
    analysis = config.analysis.model_copy(update={"spectrum_revolutions": 1})  # of four that were planned
    stored = study.compute(row, blade, case, spec, "", analysis, False).data
    expected = np.transpose(
        [(each.revolution_amplitude[1], each.revolution_peak[2]) for each in whole.blades]
    )
    np.testing.assert_array_equal([stored["blade_amplitude"], stored["blade_peak"]], expected)


def test_a_disk_that_the_loop_cannot_have_is_refused(blade, spec):
    for stiffness, message in (
        ([[1.0, 0.1], [0.2, 1.0]], "mode 1: must be a symmetric matrix"),
        (-1.5 * np.eye(2), "mode 1: the stiffness of blades and disk must be positive definite"),
        (1e6 * np.eye(2), "mode 1 of the 1 that it couples moves by .* must be 0.5 or less"),
    ):
        with pytest.raises(ValueError, match=message):
            simulate_row(blade, spec, Row.even(2, disk=Disk.of([stiffness])))


def test_draws_have_their_scatter_and_a_row_is_read_back_as_written():
    row = Row.drawn(4000, 1, 2e-5, 0.005)
    length, frequency = np.array([(of.length, of.frequency) for of in row.blades]).T
    assert np.std(length) == pytest.approx(2e-5, rel=0.05)
    assert np.std(frequency) == pytest.approx(0.005, rel=0.05)
    assert abs(np.corrcoef(length, frequency)[0, 1]) < 0.05
    assert Row.drawn(4, 2, 2e-5) != Row.drawn(4, 1, 2e-5)
    assert Row.drawn(3, 5) == Row.even(3)
    parts = {"frequency": [[0.01, -0.01], [0.0, 0.02]], "damping": [1.0, 1.3], "angle_error": [0.0, 0.01]}
    row = Row.even(2, [1e-5, 0.0], **parts, disk=Disk.ring(2, [0.01, 0.003]))
    assert Row.from_json(row.to_json()) == row


def test_runs_are_of_single_blades_unless_the_study_has_a_rotor(config):
    assert row_of(config) is None
    rotor = {"blades": 3, "length": [1e-5, 0.0, 0.0], "damping": [1.2], "coupling": [0.01, 0.003]}
    row = row_of(changed(config, rotor=rotor))
    assert row == Row.even(3, [1e-5, 0.0, 0.0], damping=1.2, disk=Disk.ring(3, [0.01, 0.003]))
    drawn = row_of(changed(config, rotor=rotor | {"length_scatter": 5e-5, "seed": 4}))
    draws = Row.drawn(3, 4, 5e-5)
    for own, plain, draw in zip(drawn.blades, row.blades, draws.blades, strict=True):
        assert own.length == plain.length + draw.length
        assert own.frequency == 0.0
    with pytest.raises(ValueError, match=r"row: 2 values of length; must be 1 or 3"):
        row_of(changed(config, rotor=rotor | {"length": [0.0, 0.0]}))


def test_the_blades_and_the_sources_of_a_row_are_part_of_its_key_alone(config, case, monkeypatch):
    spec = run_spec(config, case, 0.19)

    def key(row):
        return planned_run(config, spec, "0.1900.h5", False, row).key("blade")

    changes = [{"length": [0.0, 1e-5]}, {"frequency": 0.01}, {"frequency": [[0.01], [0.01]]}]
    changes += [{"damping": 2.0}, {"angle_error": 0.01}, {"disk": Disk.ring(2, [0.01])}]
    rows = [None, Row.even(1), Row.even(2), *(Row.even(2, **change) for change in changes)]
    keys = [key(row) for row in rows]
    assert len(set(keys)) == len(rows)
    assert [key(row) for row in rows] == keys
    run = planned_run(config, spec, "0.1900.h5", False, rows[3])
    assert longer_run(config, run).row == rows[3]
    monkeypatch.setattr(study, "rows_digest", lambda: "other")
    assert key(rows[0]) == keys[0]
    assert key(rows[1]) != keys[1]
