import numpy as np
import pandas as pd
import pytest

from bladerub.extras import small_study
from bladerub.study.grid import coating_cases
from bladerub.study.maps import DATASETS


@pytest.fixture
def made(study, blade, simulated, monkeypatch, tmp_path):
    """Conduct a study of one coating, its runs from a stand-in of the solver."""
    study["coatings"] = [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.15]}]
    study["analysis"] |= {"histories": [], "peaks": study["analysis"]["peaks"] | {"orders": [4, 6]}}
    monkeypatch.setattr(small_study, "read_reduced_blade", lambda _: blade)
    monkeypatch.setattr(small_study, "blade_digest", lambda _: "blade")
    accuracy = pd.DataFrame({"f_omega": 0.1, "mode": range(1, 8), "relative_error": 1e-3})
    monkeypatch.setattr(small_study, "read_rom_accuracy", lambda _: accuracy)

    def make(claims=None, folder=tmp_path / "study"):
        return small_study.conduct(study, "model.h5", "rom_accuracy.csv", folder, claims)

    return make


def test_a_small_study_has_all_runs_and_judges_the_claims_asked_for(made, simulated, growing, repeated):
    growing[0.19] = 0.05
    found = made({"C1"})
    assert simulated == [0.1, 0.19, 0.2, 0.3]
    assert repeated == [0.19]
    assert found.n_runs == 5
    assert list(found.divergence.f_omega) == [0.1, 0.19, 0.2, 0.3]
    assert set(found.findings["id"]) == {"C1a", "C1b"}
    simulated.clear()
    assert made({"C2"}).findings.empty
    again = made()
    assert {"C1a", "C1b"} <= set(again.findings["id"])
    assert simulated == []
    assert again.n_runs == 5


def test_without_a_folder_it_is_the_same_and_nothing_is_written(made, study, growing, simulated, tmp_path):
    growing[0.19] = 0.05
    kept = made()
    n_simulated = len(simulated)
    files = sorted(tmp_path.rglob("*"))
    passing = made(folder=None)
    assert sorted(tmp_path.rglob("*")) == files
    assert len(simulated) == 2 * n_simulated
    assert passing.n_runs == kept.n_runs == 5
    for table in ("peaks", "divergence", "findings"):
        pd.testing.assert_frame_equal(getattr(passing, table), getattr(kept, table), check_exact=True)
    (case,) = coating_cases(study)
    in_memory, of_files = passing.evidence.map(case), kept.evidence.map(case)
    for name in DATASETS.keys() - {"wear_node"}:
        assert getattr(in_memory, name).dtype == getattr(of_files, name).dtype
        np.testing.assert_array_equal(getattr(in_memory, name), getattr(of_files, name))
