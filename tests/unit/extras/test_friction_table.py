from dataclasses import replace

import pytest

from bladerub.extras.friction import table as friction
from bladerub.io.tables import described_columns
from bladerub.study.manifest import ManifestRow, write_manifest


@pytest.fixture
def stored(write_run, make_result, spec, tmp_path):
    """Write the runs of one coating under a law of friction; return the path of its manifest."""

    def write(law, speeds, amplitude=1e-3, **changes):
        result = replace(make_result(amplitude=amplitude), **changes)
        rows = []
        for f_omega in speeds:
            path = write_run(f"{law}/{f_omega:.4f}.h5", result=result, spec=replace(spec, f_omega=f_omega))
            rows.append(ManifestRow(path.name, f_omega, "key", result.status, 1, "sum"))
        write_manifest(tmp_path / law / "manifest.tsv", rows)
        return tmp_path / law / "manifest.tsv"

    return write


def test_both_laws_are_compared_speed_by_speed(stored):
    constant = stored("theta", [0.1, 0.2], n_reversed_steps=30, slowest_sliding=-0.2)
    coulomb = stored("coulomb", [0.1, 0.2], amplitude=1.1e-3, n_reversed_steps=60, status="unbounded")
    table = friction.table([(constant, coulomb)], revolutions=10)
    assert list(table.columns) == friction.COLUMNS
    assert set(table.columns) <= described_columns().keys()
    assert list(table.f_omega) == [0.1, 0.2]
    first = table.iloc[0]
    assert first.peak_theta == pytest.approx(1e-3, rel=1e-4)
    assert first.peak_coulomb == pytest.approx(1.1e-3, rel=1e-4)
    assert first.difference == pytest.approx(0.1)
    assert (first.reversed_theta, first.reversed_coulomb) == pytest.approx((0.1, 0.2))
    assert first.slowest_sliding == -0.2
    assert (first.status_theta, first.status_coulomb) == ("completed", "unbounded")
