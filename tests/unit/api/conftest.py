import pytest
from stand_in import COARSE

import bladerub as br


@pytest.fixture(scope="session")
def small(tmp_path_factory):
    folder = tmp_path_factory.mktemp("api")
    (folder / "small.yaml").write_text(COARSE + "results: results_of_no_workflow\n")
    return folder


@pytest.fixture(scope="session")
def study(small):
    return br.load_study(small / "small.yaml")


@pytest.fixture(scope="session")
def blade(study, small):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BLADERUB_CACHE", str(small / "cache"))
        return br.build_blade(study)


@pytest.fixture(scope="session")
def run(study, blade):
    return br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=3), follow=False)


@pytest.fixture(scope="session")
def sweep(study, blade):
    return br.simulate_speeds(blade, study.coating("2nd", E=2, K=0.5), [0.2, 0.19], progress=False)
