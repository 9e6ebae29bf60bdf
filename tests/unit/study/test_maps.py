import dataclasses

import numpy as np
import pytest

from bladerub.io.errors import DamagedFile
from bladerub.study import grid, maps
from bladerub.study.growth import confirmation_spec
from bladerub.study.manifest import ManifestRow, confirmation_path, read_manifest, write_manifest

SPEEDS = [0.1, 0.19, 0.3]


@pytest.fixture
def folder(tmp_path, config, case, make_result, write_run):
    """Runs of one coating that vibrate and wear at orders 10, 6, 4; the manifest is not in order of speed.

    The middle one was repeated for longer; of the last there is a longer one that the study has no use for.
    """
    rows = []
    for f_omega, order in zip(SPEEDS, (10, 6, 4), strict=True):
        result = make_result(order=order, complete=15 if order == 4 else None)
        spec = grid.run_spec(config, case, f_omega)
        name = f"{grid.speed_name(f_omega)}.h5"
        write_run(name, f"key {order}", result, history=order == 6, spec=spec)
        if order != 10:
            long_spec = confirmation_spec(spec, config.analysis.divergence)
            longer = make_result(revolutions=60, growth=0.03)
            write_run(f"confirmation/{name}", f"long {order}", longer, spec=long_spec)
        long_key = "long 6" if order == 6 else ""
        rows.append(ManifestRow(name, f_omega, f"key {order}", result.status, 1, long_key, 1))
    write_manifest(tmp_path / "manifest.tsv", reversed(rows))
    return tmp_path


@pytest.fixture
def collect(config, case, blade, folder):
    rows = read_manifest(folder / "manifest.tsv")
    return lambda: maps.collect_listed(config, case, blade, folder, rows)


def test_a_map_gathers_the_runs_by_speed(collect, make_result):
    coating = collect()
    np.testing.assert_array_equal(coating.f_omega, SPEEDS)
    np.testing.assert_allclose(coating.C1, np.sqrt(1 + 3 * np.square(SPEEDS)))
    assert list(coating.lobes) == [10, 6, 4]
    assert list(coating.status) == ["completed", "completed", "unbounded"]
    assert [coating.spectrum_order[row.argmax()] for row in coating.spectrum_amplitude] == [10, 6, 4]
    assert coating.revolution_peak.shape == coating.revolution_amplitude.shape == (3, 20)
    assert coating.confirmation_amplitude.shape == (3, 60)
    np.testing.assert_allclose(coating.confirmation_amplitude[1], 1e-3 * 1.03 ** np.arange(60), rtol=1e-4)
    assert np.isnan(coating.confirmation_amplitude[[0, 2]]).all()
    np.testing.assert_allclose(coating.max_wear, 2e-4, rtol=1e-3)
    wear = make_result(order=6).wear
    np.testing.assert_allclose(coating.wear_node[1], wear, atol=1e-10)
    np.testing.assert_allclose(coating.wear[1], wear.mean(axis=0), atol=1e-10)


def test_a_map_comes_back_as_written(tmp_path, case, make_map):
    written = make_map(case, {4: (0.3, 1e-4)}, status="completed")
    maps.write_map(tmp_path / "map.h5", written, {})
    assert maps.read_map(tmp_path / "map.h5").wear_node is None
    read = maps.read_map(tmp_path / "map.h5", with_nodes=True)
    assert read.case == case
    for field in dataclasses.fields(written)[1:]:
        np.testing.assert_array_equal(getattr(read, field.name), getattr(written, field.name))


@pytest.mark.parametrize("which", ["runs", "longer runs"])
def test_a_run_that_is_damaged_missing_or_stale_is_named(collect, folder, which):
    paths = [folder / "0.1900.h5", folder / "0.3000.h5"]
    path, other = paths if which == "runs" else map(confirmation_path, paths)
    name = path.relative_to(folder)
    path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(DamagedFile, match=rf"{name}: not a readable HDF5 file"):
        collect()
    path.write_bytes(other.read_bytes())
    with pytest.raises(OSError, match=rf"{name}: not the run that .*manifest\.tsv lists"):
        collect()
    path.unlink()
    with pytest.raises(OSError, match=rf"No such file .*{name}"):
        collect()
