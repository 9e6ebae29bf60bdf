import pytest

from bladerub.blade.build import build
from bladerub.config.read import load
from bladerub.contact.run import simulate
from bladerub.io.folders import ROOT
from bladerub.study.grid import CoatingCase, run_spec
from tests.unit.stand_in import change  # noqa: F401 (fixture)


@pytest.fixture
def paper_config():
    """The paper's study, to change at will."""
    return load(ROOT / "config" / "config.yaml")


@pytest.fixture(scope="session")
def built():
    """The default blade as it is built for the paper's study."""
    return build(load(ROOT / "config" / "config.yaml"))


@pytest.fixture(scope="session")
def coarse_config():
    """The paper's study on a coarse mesh of the same blade, which is built in a second."""
    config = load(ROOT / "config" / "config.yaml")
    config["blade"]["mesh"] = {"chordwise": 8, "thickness": 2, "spanwise": 8}
    config["reduction"].update(accuracy_speeds=2, accuracy_modes=7)
    return config


@pytest.fixture(scope="session")
def coarse_blade(coarse_config):
    return build(coarse_config).reduced


@pytest.fixture(scope="session")
def spec_of(coarse_config, change):  # noqa: F811
    """Give a run of a coating on the casing with 2 nodal diameters, with other values where given."""

    def spec_of(E, K, f_omega, theta=0.0, **values):
        return change(run_spec(coarse_config, CoatingCase("2nd", E, K, theta), f_omega), **values)

    return spec_of


@pytest.fixture(scope="session")
def run(spec_of, coarse_blade):
    return lambda *coating, **values: simulate(coarse_blade, spec_of(*coating, **values))
