"""How the cores are divided among jobs."""

import pytest

from bladerub.workflow.cores import threads_for


@pytest.mark.parametrize(
    ("cost", "cores", "threads"),
    [
        (1, 2, 1),  # a hundredth of all
        (1, 16, 1),
        (1, 64, 5),
        (10, 2, 1),
        (10, 4, 3),
        (10, 16, 12),
        (100, 4, 4),  # the only job
        (100, 1, 1),
        (10, None, 1),
    ],
)
def test_a_job_larger_than_the_share_of_a_core_has_more_threads(cost, cores, threads):
    assert threads_for(cost, 100, cores) == threads
