"""The calls of CuPy, on one that works on arrays of NumPy; and what is said where there is none."""

import sys
from functools import cache
from types import SimpleNamespace
from typing import ClassVar
from unittest.mock import MagicMock

import numpy as np
import pytest

from bladerub.contact.run import simulate
from bladerub.extras.gpu import device, emulation
from bladerub.extras.gpu.many import simulate_many


class Array(np.ndarray):
    """With the memory that CuPy gives an array."""

    @property
    def data(self):
        memory = np.asarray(self).reshape(-1).view(np.uint8)
        return SimpleNamespace(
            ptr=self.ctypes.data, memset_async=lambda value, size: memory[:size].fill(value)
        )


class Kernel:
    """The emulation; lists the grids of its launches."""

    grids: ClassVar = []

    def __init__(self, source):
        self.source = source

    def __call__(self, grid, block, arguments, shared_mem):
        self.grids.append(grid)
        assert block == (32,)
        assert shared_mem == self.max_dynamic_shared_size_bytes > 0
        n_runs, *arrays = arguments
        emulation.call(emulation._compiled(self.source, "double"), int(n_runs), *arrays)


@pytest.fixture
def cupy(monkeypatch):
    """Stand in for CuPy."""
    monkeypatch.setattr(device, "_compiled", cache(device._compiled.__wrapped__))
    monkeypatch.setattr(Kernel, "grids", [])
    module = MagicMock(asnumpy=np.array)
    module.asarray = lambda given: np.array(given).view(Array)
    module.empty = lambda shape, dtype: np.empty(shape, dtype).view(Array)
    module.RawModule = lambda code, options: SimpleNamespace(get_function=lambda name: Kernel(code))
    module.cuda.Device.return_value = SimpleNamespace(
        mem_info=(0, 10**9), attributes={"MultiProcessorCount": 2}
    )
    module.cuda.runtime.CUDARuntimeError = RuntimeError
    monkeypatch.setitem(sys.modules, "cupy", module)
    return module


@pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
def test_runs_of_several_sizes_share_a_kernel(cupy, blade, spec, change):
    """Those of a wider profile have one of their own."""
    sizes = [{"revolutions": 2}, {"n_elements": 150}, {"displacement_limit": 4e-4, "revolutions": 6}]
    sizes += [{"half_width": 2.6}]
    specs = [change(spec, **size) for size in sizes]
    found = dict(simulate_many(blade, specs, device.run))
    for number, each in enumerate(specs):
        expected = simulate(blade, each)
        np.testing.assert_allclose(found[number].wear, expected.wear, rtol=0, atol=1e-9)
        whole = expected.radial_displacement  # NaN beyond the limit
        np.testing.assert_allclose(found[number].radial_displacement, whole, rtol=0, atol=1e-9)
        assert found[number].n_steps == expected.n_steps
    assert Kernel.grids == [(3,), (1,)]


def test_without_a_gpu_it_is_said_what_to_take(cupy):
    cupy.cuda.runtime.getDeviceCount.side_effect = RuntimeError("no driver")
    with pytest.raises(device.NoGpuError, match=r"was found \(no driver\): take solver.device"):
        device.connect()
