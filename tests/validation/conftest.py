import pytest

from bladerub.blade.build import build
from bladerub.config.read import read
from bladerub.contact.run import simulate
from bladerub.io.folders import ROOT
from bladerub.settings.blade import Mesh
from bladerub.study.grid import CoatingCase, run_spec
from tests.unit.stand_in import change  # noqa: F401 (fixture)


@pytest.fixture(scope="session")
def paper_config():
    return read(ROOT / "config" / "config.yaml")


@pytest.fixture(scope="session")
def built(paper_config):
    return build(paper_config)


@pytest.fixture(scope="session")
def coarse_config(paper_config):
    """The paper's study on a coarse mesh of the same blade, which is built in a second."""
    coarse = paper_config.replaced("blade.mesh", Mesh(chordwise=8, thickness=2, spanwise=8))
    return coarse.replaced("reduction.accuracy_speeds", 2).replaced("reduction.accuracy_modes", 7)


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
