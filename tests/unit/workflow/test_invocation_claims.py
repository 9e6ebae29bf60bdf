import json
import subprocess
import sys

import pytest

from bladerub.io.errors import BadInput
from bladerub.workflow.claims import claim

CLAIM = """
import sys
from bladerub.workflow.claims import claim
print(claim(sys.argv[1], ["a", "b"], ["c"]), flush=True)
sys.stdin.read()
"""


@pytest.fixture
def other(tmp_path):
    """Another process, which makes a and b of c."""
    with subprocess.Popen(
        [sys.executable, "-c", CLAIM, tmp_path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout.readline() == "False\n"
        yield process
        process.kill()


@pytest.mark.parametrize(("outputs", "inputs"), [("a", ""), ("x", "b"), ("c", "")])
def test_who_makes_or_needs_what_another_makes_is_kept_out(other, tmp_path, outputs, inputs):
    with pytest.raises(BadInput, match="another snakemake is at work"):
        claim(tmp_path, outputs, inputs)


def test_who_shares_but_inputs_is_let_in(other, tmp_path):
    assert claim(tmp_path, "x", "c") is False


def test_the_claim_of_the_dead_is_void(other, tmp_path):
    other.kill()
    other.wait()
    assert claim(tmp_path, "a", "c") is True
    (remaining,) = tmp_path.glob("*.json")
    assert json.loads(remaining.read_text()) == {"makes": ["a"], "needs": ["c"]}


def test_an_orderly_end_leaves_no_claim(other, tmp_path):
    other.communicate()
    assert list(tmp_path.glob("*.json")) == []
