"""The loop of the GPU by NVIDIA's own compiler (NVRTC), which needs no GPU: registers and what they spill."""

import re

import pytest

from bladerub.contact.laws import NAMES
from bladerub.contact.spec import PLASTIC, ElementLaw
from bladerub.extras.gpu import batch, device

REGISTERS = 255  # of a thread
nvrtc = pytest.importorskip("cupy_backends.cuda.libs.nvrtc", reason="no CuPy; pip install -e .[gpu]")


def compile_for(architecture: str, variant: batch.Variant) -> tuple[int, int]:
    """Compile the loop; return registers of a thread and bytes that it spills."""
    try:
        program = nvrtc.createProgram(batch.source(variant), "loop.cu", (), ())
    except RuntimeError as error:
        pytest.skip(f"no NVRTC: {error}")
    options = (*device.OPTIONS, f"--gpu-architecture={architecture}", "--ptxas-options=-v")
    try:
        nvrtc.compileProgram(program, options)
    finally:
        told = nvrtc.getProgramLog(program)
        nvrtc.destroyProgram(program)
    assert "warning" not in told, told
    return tuple(int(re.search(text, told)[1]) for text in (r"Used (\d+) reg", r"(\d+) bytes spill stores"))


@pytest.mark.parametrize("vectors", [1, 2, 3, 4])
@pytest.mark.parametrize("turns", [False, True])
def test_the_loop_needs_no_memory_for_its_registers(vectors, turns):
    used, spilled = compile_for("sm_90", batch.Variant(vectors, turns, 2, PLASTIC, 2000, 20))
    print(f"{32 * vectors} modes, profile turns {turns}: {used} registers, {spilled} bytes spilled")
    assert used <= REGISTERS
    if vectors <= 3 and not turns:  # the study
        assert spilled <= 64


OTHERS = [(other, PLASTIC) for other in ("sm_80", "sm_89", "sm_100")]


@pytest.mark.parametrize(("architecture", "law"), OTHERS + [("sm_90", ElementLaw(name)) for name in NAMES])
def test_other_processors_and_laws(architecture, law):
    used, _ = compile_for(architecture, batch.Variant(3, False, 2, law, 2000, 20))
    assert used <= REGISTERS
