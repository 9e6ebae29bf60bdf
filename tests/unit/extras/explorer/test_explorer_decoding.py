"""How the page's own program, outside a browser, reads what was packed: it converts no unit."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from bladerub.extras import explorer
from bladerub.extras.explorer.encoding import differences, linear_steps, logarithmic_steps

NODE = shutil.which("node")
pytestmark = [pytest.mark.browser, pytest.mark.skipif(NODE is None, reason="no node; apt-get install nodejs")]

PAGE = Path(explorer.__file__).parent / "page"
DOCUMENT = 'const document = { getElementById: () => ({ textContent: "{}" }) };\n'


def evaluate(script, expression):
    """Evaluate an expression after one of the page's scripts."""
    program = (
        f"{DOCUMENT}{(PAGE / script).read_text(encoding='utf-8')}\nconsole.log(JSON.stringify({expression}));"
    )
    done = subprocess.run([NODE, "-"], input=program, check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def test_depths_of_wear_are_those_packed():
    depth = np.random.default_rng(1).random((3, 40))
    steps, deepest = linear_steps(depth)
    data = f"Uint8Array.from({differences(steps).ravel().tolist()}).buffer"
    rows = evaluate("data.js", f"wear({data}, {deepest.tolist()}).map((row) => [...row])")
    np.testing.assert_allclose(rows, depth, rtol=0, atol=depth.max() / 510 * 1.001)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_amplitudes_are_those_packed(dtype):
    amplitude = 10 ** np.random.default_rng(2).uniform(-7, -2, 50)
    steps, top = logarithmic_steps(amplitude, 1e-7, 1e-2, dtype), np.iinfo(dtype).max
    values = evaluate("data.js", f"[...ratios({steps.tolist()}, {top}, [1e-7, 1e-2])]")
    np.testing.assert_allclose(values, amplitude, rtol=np.log(1e5) / (top - 1) / 2 * 1.001)


@pytest.mark.parametrize(("length", "words"), [("1.23456", "1.235 mm"), ("null", "none")])
def test_lengths_are_written_in_mm(length, words):
    assert evaluate("words.js", f"millimetres({length})") == words
