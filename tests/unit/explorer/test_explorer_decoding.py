"""What the page makes of its codes, by its own program outside a browser: depths and amplitudes in mm."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from bladerub import explorer
from bladerub.explorer.codes import differences, linear, logarithmic

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


def test_depths_of_wear_are_in_mm():
    depth = 1e-3 * np.random.default_rng(1).random((3, 40))  # m
    codes, deepest = linear(depth)
    data = f"Uint8Array.from({differences(codes).ravel().tolist()}).buffer"
    rows = evaluate("data.js", f"wear({data}, {deepest.tolist()}).map((row) => [...row])")
    np.testing.assert_allclose(rows, 1e3 * depth, rtol=0, atol=1e3 * depth.max() / 510 * 1.001)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_amplitudes_are_in_mm(dtype):
    amplitude = 10 ** np.random.default_rng(2).uniform(-7, -2, 50)  # m
    codes, top = logarithmic(amplitude, 1e-7, 1e-2, dtype), np.iinfo(dtype).max
    values = evaluate("data.js", f"[...ratios({codes.tolist()}, {top}, [1e-7, 1e-2])]")
    np.testing.assert_allclose(values, 1e3 * amplitude, rtol=np.log(1e5) / (top - 1) / 2 * 1.001)


def test_a_code_of_zero_is_no_value():
    assert evaluate("data.js", "[...ratios([0, 1], 255, [1e-7, 1e-2])].map(Number.isNaN)") == [True, False]


@pytest.mark.parametrize(("metres", "words"), [("0.00123456", "1.235 mm"), ("null", "none")])
def test_lengths_are_said_in_mm(metres, words):
    assert evaluate("words.js", f"millimetres({metres})") == words
