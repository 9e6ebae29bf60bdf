"""The calls of CuPy, on one that works on arrays of NumPy; and what is said where there is none."""

import sys
from collections import defaultdict
from contextlib import nullcontext
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

from bladerub.contact.run import simulate
from bladerub.extras.gpu import device, emulation
from bladerub.extras.gpu.many import simulate_many


class Stream(nullcontext):
    def __init__(self, non_blocking):
        super().__init__()
        assert non_blocking

    def synchronize(self):
        pass


class Array(np.ndarray):
    """With the memory that CuPy gives an array."""

    def __new__(cls, shape, dtype):
        array = np.empty(shape, dtype).view(cls)
        memory = np.asarray(array).reshape(-1).view(np.uint8)
        array.memory = SimpleNamespace(
            ptr=array.ctypes.data, memset_async=lambda value, size: memory[:size].fill(value)
        )
        return array

    @classmethod
    def of(cls, given):
        array = cls(given.shape, given.dtype)
        array[...] = given
        return array

    @property
    def data(self):
        return self.memory


@pytest.fixture
def cupy(monkeypatch):
    """Stand in for CuPy; the kernel is the emulation. Lists the launches."""
    device._compiled.cache_clear()
    launches = defaultdict(list)

    class Kernel:
        def __init__(self, source):
            self.source = source

        def __call__(self, grid, block, arguments, shared_mem):
            launches["grid"].append(grid)
            assert block == (32,)
            assert shared_mem == self.max_dynamic_shared_size_bytes > 0
            n_runs, *arrays = arguments
            emulation.call(emulation._compiled(self.source, "double"), int(n_runs), *arrays)

    module = ModuleType("cupy")
    module.asarray, module.empty = Array.of, Array
    module.asnumpy = np.array
    module.RawModule = lambda code, options: SimpleNamespace(get_function=lambda name: Kernel(code))
    chip = SimpleNamespace(mem_info=(0, 10**9), attributes={"MultiProcessorCount": 2})
    runtime = SimpleNamespace(getDeviceCount=lambda: 1, CUDARuntimeError=RuntimeError)
    module.cuda = SimpleNamespace(
        Stream=Stream, Device=lambda: chip, runtime=runtime, get_current_stream=lambda: Stream(True)
    )
    monkeypatch.setitem(sys.modules, "cupy", module)
    yield SimpleNamespace(launches=launches, chip=chip)
    device._compiled.cache_clear()


@pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
def test_runs_of_several_sizes_share_a_kernel(cupy, blade, spec, change):
    """Those of a wider profile have one of their own."""
    sizes = [{"revolutions": 2}, {"n_elements": 150}, {}, {"half_width": 2.6}]
    specs = [change(spec, **size) for size in sizes]
    found = dict(simulate_many(blade, specs, device.run))
    for number, each in enumerate(specs):
        expected = simulate(blade, each)
        np.testing.assert_allclose(found[number].wear, expected.wear, rtol=0, atol=1e-9)
        assert found[number].radial_displacement.shape == expected.radial_displacement.shape
        assert found[number].n_steps == expected.n_steps
    assert cupy.launches["grid"] == [(3,), (1,)]


def test_without_a_gpu_it_is_said_what_to_take(cupy, monkeypatch):
    def none():
        raise RuntimeError("no driver")

    monkeypatch.setattr(sys.modules["cupy"].cuda.runtime, "getDeviceCount", none)
    with pytest.raises(
        device.NoGpuError, match=r"no GPU of NVIDIA was found \(no driver\): take solver.device"
    ):
        device.connect()
