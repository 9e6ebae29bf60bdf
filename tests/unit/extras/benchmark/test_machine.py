"""What the benchmark says of the machine."""

import os

from bladerub.extras.benchmark import machine


def test_the_machine_is_described():
    told = machine.describe()
    assert told["processor"].strip()
    assert told["vector_bits"] in {64, 128, 256, 512}
    assert 1 <= told["cores"] <= os.cpu_count()
