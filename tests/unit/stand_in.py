import dataclasses
import re
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np
import pytest

from bladerub.blade.model import ReducedBlade
from bladerub.contact.spec import Casing, Coating, RunSpec, TipProfile
from bladerub.io import checksum

COARSE = "blade: {mesh: {chordwise: 7, thickness: 1, spanwise: 6}}\nreduction: {accuracy_speeds: 3}\n"


@pytest.fixture(scope="session")
def blade():
    """A dense 30-coordinate stand-in with the tip geometry of a blade; its highest mode is at 30 kHz."""
    angle = np.linspace(-0.05, 0.05, 8)
    return made_blade(np.random.default_rng(7), 192.0, np.linspace(-0.023, 0.024, 8), angle, 0.65)


def made_blade(rng, lowest, x, angle, radius, cone=0.0, **more):
    """Make a blade with any modes from `lowest` to 30 kHz, with nodes at these `x` (m), angles and radius."""
    n = 3 * len(angle) + 6
    vectors, _ = np.linalg.qr(rng.normal(size=(n, n)))
    omega = 2 * np.pi * np.geomspace(lowest, 30e3, n)
    root_mass = np.sqrt(np.geomspace(0.05, 2e-3, n))
    stiffness = root_mass[:, None] * (vectors * omega**2) @ vectors.T * root_mass
    zero, sine, cosine = 0 * angle, np.sin(angle), np.cos(angle)
    return ReducedBlade(
        mass=np.diag(root_mass**2),
        stiffness_0=stiffness,
        stiffness_1=0.6 * stiffness,
        stiffness_2=0.01 * stiffness,
        node_position=np.column_stack([x, radius * sine, radius * cosine]),
        radial_direction=np.column_stack([zero + np.sin(cone), np.cos(cone) * sine, np.cos(cone) * cosine]),
        tangential_direction=np.column_stack([zero, cosine, -sine]),
        f1_hz=192.0,
        f_omega_max=0.4,
        eta=6,
        rank_tolerance=1e-5,
        length=0.2,
        **more,
    )


@pytest.fixture(scope="session")
def spec():
    """A short run with a coarse ring, so that nodes meet many elements, lobes and the wrap-around."""
    return RunSpec(
        casing=Casing("2nd5nd", (2, 5), (0.25, 1.0), 0.5e-3, 0.3e-3, np.deg2rad(108.0)),
        coating=Coating(1.1, 0.5, 0.1, 1e-6, 150e6, 5e-3, 200),
        tip=TipProfile(2.0, 20e-6),
        clearance=(30e-6, 86e-6),
        damping_ratio=2.3e-3,
        f_omega=0.3,
        revolutions=2,
        scheme="exponential",
        steps_per_element=12,
        max_time_step=1e-5,
        displacement_limit=0.02,
    )


@pytest.fixture(scope="session")
def change():
    """Copy a spec with other values; keys of the coating, casing or tip are found where they are."""

    def changed(spec, **values):
        for part in ("coating", "casing", "tip"):
            names = {field.name for field in dataclasses.fields(getattr(spec, part))} & values.keys()
            inner = {name: values.pop(name) for name in names}
            spec = dataclasses.replace(spec, **{part: dataclasses.replace(getattr(spec, part), **inner)})
        return dataclasses.replace(spec, **values)

    return changed


@contextmanager
def edited(path):
    """Open an HDF5 file for changes, and give it the checksum of what it holds then, as if so written."""
    with h5py.File(path, "r+") as file:
        yield file
    image = re.sub(b"sha256=[0-9a-f]{64}", b"sha256=" + 64 * b"0", Path(path).read_bytes())
    Path(path).write_bytes(checksum.seal(image))
