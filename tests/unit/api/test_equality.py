"""Every public object equals itself after it is written and read, pickled, or made again of what it says."""

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest

import bladerub as br
from bladerub.io.values import equal
from bladerub.study.manifest import ManifestRow, confirmation_path, write_manifest


@pytest.fixture(scope="module")
def planned(study):
    return study.run("2nd", E=2, K=0.5, f_omega=0.2)


@pytest.fixture(scope="module")
def followed(blade, planned):
    return br.simulate(blade, planned, stress=True)


@pytest.fixture(scope="module")
def ensemble(blade, planned, followed):
    return br.simulate_ensemble(blade, planned, 2, own=followed, jobs=2, progress=False)


@pytest.mark.extras
def test_a_run_is_written_whole(study, run, followed, blade, tmp_path):
    settings = study.config.analysis.divergence
    assert followed.longer
    assert followed.stress
    unbounded = br.simulate(blade, study.rigid("2nd", friction=1.0).at(0.19, revolutions=3))
    assert np.isnan(unbounded.spectrum).all()  # it ends within its first revolution
    row = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19), row=br.Row.even(2, length=[0, 5e-5]))
    for number, each in enumerate((run, followed, unbounded, row)):
        path = tmp_path / f"{number}.h5"
        each.write(path, study.config)
        read = br.read_run(path)
        assert read == each
        assert equal(read.verdict(settings), each.verdict(settings))
        assert read.summary(study.config) == each.summary(study.config)
        assert read.to_xarray().drop_attrs().identical(each.to_xarray().drop_attrs())
    assert followed != replace(followed, longer=None)
    assert followed != replace(followed, stress=None)


@pytest.mark.extras
def test_the_longer_run_of_a_study_is_the_one_that_its_manifest_lists(study, run, followed, tmp_path):
    path, key = tmp_path / "0.2000.h5", followed.attributes["run_key"]
    run.write(confirmation_path(path), study.config)
    replace(followed, longer=None).write(path, study.config)
    assert br.read_run(path).longer is None  # it does not begin as the run
    followed.longer.write(confirmation_path(path), study.config)
    assert br.read_run(path) == followed  # the job is not done, or this is no study
    listed = ManifestRow(path.name, 0.2, key, "completed", path.stat().st_size)
    write_manifest(path.with_name("manifest.tsv"), [listed])
    assert br.read_run(path).longer is None
    longer_key = followed.longer.attributes["run_key"]
    write_manifest(path.with_name("manifest.tsv"), [listed._replace(confirmation_key=longer_key)])
    assert br.read_run(path) == followed


@pytest.mark.extras
def test_maps_and_ensembles_are_written_whole(study, blade, sweep, planned, ensemble, tmp_path):
    from bladerub.extras.ensembles import ensemble as study_ensemble

    sweep.write(tmp_path / "map.h5", study.config)
    assert br.read_map(tmp_path / "map.h5") == sweep
    ensemble.write(tmp_path / "ensemble.h5")
    read = br.read_ensemble(tmp_path / "ensemble.h5", planned)
    assert read == ensemble
    assert read.bands().equals(ensemble.bands())
    low, high = 1e3 * ensemble.bands().loc["max_wear", ["low", "high"]]
    assert f"{low:.4g} to {high:.4g} mm" in repr(ensemble)
    assert br.read_run(tmp_path / "ensemble.h5").wear.tolist() == ensemble.runs[0].wear.tolist()
    with pytest.raises(br.InputError, match="must be that of"):
        br.read_ensemble(tmp_path / "ensemble.h5", study.run("2nd", E=2, K=0.5, f_omega=0.19))
    with pytest.raises(br.InputError, match="must be that of own"):
        br.simulate_ensemble(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19), own=ensemble.runs[0])
    damped = study.replace("contact.damping_ratio", 0.02).run("2nd", E=2, K=0.5, f_omega=0.2)
    with pytest.raises(br.InputError, match="must be of the study of"):
        br.read_ensemble(tmp_path / "ensemble.h5", damped)
    with pytest.raises(br.InputError, match="must be of the same blade, study"):
        br.simulate_ensemble(blade, damped, own=ensemble.runs[0])
    *members, finer = (
        replace(sweep.coating, wear_node=None, lobes=sweep.coating.lobes + n) for n in range(3)
    )
    of_study = study_ensemble.Ensemble(np.array([[1e-9, 2e-9], [3e-9, 4e-9]]), tuple(members), finer)
    study_ensemble.write(tmp_path / "of_study.h5", of_study, {})
    assert study_ensemble.read(tmp_path / "of_study.h5") == of_study


@pytest.mark.extras
def test_every_public_object_survives_a_pickle(study, blade, run, sweep, planned, ensemble):
    law = br.Law("viscoplastic", viscosity=1e4)
    sizes = {"thickness": 3e-3, "tip_width": 1e-2, "tip_length": 2e-3, "track": 1.0, "law": law.element_law}
    rig = br.Rig("mine", E=6e8, K=3e8, yield_stress=0, speed=125.0, incursion=1e-5, **sizes)
    row = br.Row.even(3, frequency=[[0.01, -0.02], [0, 0], [0, 0]], disk=br.Disk.ring(3, [1e-3]))
    objects = [study, study.coatings[0], planned, blade, run, sweep, ensemble, rig, row, row.blades[0]]
    objects += [row.disk, law]
    for each in objects:
        again = pickle.loads(pickle.dumps(each))
        assert again == each, type(each)
    assert br.Law(**json.loads(json.dumps(law.entry))) == law
    assert br.Row.from_json(row.to_json()) == row
    errors = [br.InputError("K", -1.0, "must be above 0"), br.ConfigError([])]
    for error in errors:
        again = pickle.loads(pickle.dumps(error))
        assert (type(again), str(again), vars(again)) == (type(error), str(error), vars(error))
    classes = {name for name in dir(br) if isinstance(getattr(br, name), type)}
    assert classes == {type(each).__name__ for each in (*objects, *errors)}
