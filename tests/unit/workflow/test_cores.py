"""How the cores are divided among jobs."""

import pytest

from bladerub.config import read as configuration
from bladerub.workflow.cores import costs_of, priority_of, threads_for


@pytest.mark.parametrize(
    ("cost", "cores", "threads"),
    [
        (1, 16, 1),
        (1, 64, 5),
        (10, 4, 3),
        (100, 4, 4),  # the only job
        (10, None, 1),
    ],
)
def test_a_job_larger_than_the_share_of_a_core_has_more_threads(cost, cores, threads):
    assert threads_for(cost, 100, cores) == threads


def test_the_study_begins_with_the_coating_of_fig_6_and_the_stiffest():
    """The largest ensembles and the slowest runs: either would otherwise end long after all else."""
    costs = costs_of(configuration.read("config/config.yaml", command_line={}))
    first, second, *_ = sorted(costs.runs, key=lambda coating: -priority_of(coating, costs))
    assert (first, second.partition("_K")[0]) == ("2nd5nd_E11_K0.5_theta0", "2nd_E20")
