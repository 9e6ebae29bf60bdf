"""The direct contact of Rotor 37 as NLstep integrates it: the case in its form, and what it answers.

NLstep (Monjaraz-Tec, Gross and Krack, Comput. Struct. 260 (2022) 106698) has a massless boundary with three
directions at each node, and a gap that depends on the time alone. It is not part of this repository: its
function `sim_contact3D` is run by GNU Octave.
"""

import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import scipy.io

from bladerub.blade.model import ReducedBlade
from bladerub.contact import casing
from bladerub.contact.modes import mode_shapes_at, tip_radii
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import running_clearance
from bladerub.extras.rotor37 import direct
from bladerub.extras.rotor37.numbers import of_displacement
from bladerub.io.errors import BadInput
from bladerub.settings.study import Config

VARIABLE = "BLADERUB_NLSTEP"  # environment variable with the folder of `FUNCTION`
FUNCTION = "sim_contact3D.m"
OCTAVE = "octave-cli"
DRIVER = Path(__file__).parent / "octave" / "direct_contact.m"  # the class next to it is NLstep's model
CASES = [  # coefficient of friction, modes that move, and time steps in a revolution
    *((0.0, 20, 1500), (0.0, 20, 3000)),
    *((0.15, 10, 1500), (0.15, 20, 1500), (0.15, 20, 3000), (0.15, 50, 4000)),
]
COLUMNS = ["modes", "steps_per_revolution", "number", "value", "unit"]

_DIFFERENCE = 1e-6  # rad, for the slope of the casing


def massless_boundary(
    blade: ReducedBlade, f_omega: float, damping_ratio: float, n_modes: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Reduce the blade to its interface and free modes without mass of the interface (MacNeal 1971).

    `n_modes` free modes move, damped by `damping_ratio`; the others respond by their static displacement.
    Returns mass, damping and stiffness (3 j + n_modes, 3 j + n_modes), kg, N s/m and N/m, for displacements
    of each of the j interface nodes along its `directions`, m, then the modes, kg^1/2 m. Raises `ValueError`
    if the modes left do not span the displacements of the interface.
    """
    omega, shapes = mode_shapes_at(blade, f_omega)
    n_boundary, n_static = 3 * blade.n_interface, omega.size - n_modes
    if n_static < n_boundary:
        raise ValueError(f"{n_modes} moving modes: {n_static} are left for the {n_boundary} displacements")
    interface = shapes[:n_boundary].reshape(blade.n_interface, 3, -1)
    boundary = np.einsum("jda,jan->jdn", directions(blade), interface).reshape(n_boundary, -1)
    moving, static = boundary[:, :n_modes], boundary[:, n_modes:]
    residual = np.linalg.inv((static / omega[n_modes:] ** 2) @ static.T)
    coupling = residual @ moving
    modal = np.diag(omega[:n_modes] ** 2) + moving.T @ coupling
    stiffness = np.block([[residual, -coupling], [-coupling.T, modal]])
    mass, damping = np.zeros_like(stiffness), np.zeros_like(stiffness)
    mass[n_boundary:, n_boundary:] = np.eye(n_modes)
    damping[n_boundary:, n_boundary:] = np.diag(2 * damping_ratio * omega[:n_modes])
    return mass, damping, (stiffness + stiffness.T) / 2


def directions(blade: ReducedBlade) -> np.ndarray:
    """Return unit vectors (j, 3, 3) at the interface nodes: inward, with the rotation, and the third."""
    inward = -blade.radial_direction
    third = np.cross(inward, blade.tangential_direction)
    return np.stack([inward, blade.tangential_direction, third], axis=1)


def case(blade: ReducedBlade, spec: RunSpec, n_modes: int, steps: int) -> dict[str, Any]:
    """State a run on the rigid casing for NLstep; arrays over nodes and times, SI units."""
    mass, damping, stiffness = massless_boundary(blade, spec.f_omega, spec.damping_ratio, n_modes)
    speed = 2 * np.pi * spec.f_omega * blade.f1_hz
    time = np.arange(spec.revolutions * steps + 1) * (2 * np.pi / speed / steps)
    _, y, z = blade.node_position.T
    clearance = running_clearance(blade, spec)[:, None]
    angle = (spec.casing.start_angle + np.arctan2(y, z))[:, None] + speed * time
    before, after = (casing.gap(spec.casing, clearance, angle + sign * _DIFFERENCE) for sign in (-1, 1))
    model = {"mass": mass, "damping": damping, "stiffness": stiffness, "time": time}
    return model | {
        "gap": casing.gap(spec.casing, clearance, angle),
        "opening_speed": (after - before) / (2 * _DIFFERENCE) * speed,
        "sliding_speed": tip_radii(blade)[0] * speed,
        "friction": np.tan(spec.coating.theta),
    }


def program() -> Path:
    """Find NLstep's time integration; `BadInput` if it or Octave is missing."""
    folder = os.environ.get(VARIABLE)
    function = Path(folder or "") / FUNCTION
    problems = []
    if not folder or not function.is_file():
        right = f"must be the folder with {FUNCTION} (SRC of NLstep)"
        problems.append(f"{VARIABLE} = {folder or 'not set'}: {right}")
    if shutil.which(OCTAVE) is None:
        problems.append(f"{OCTAVE}: not found; NLstep needs GNU Octave here")
    if problems:
        raise BadInput("\n".join(problems))
    return function


def describe(function: Path) -> str:
    """Say which NLstep and Octave these are."""
    digest = hashlib.sha256(function.read_bytes()).hexdigest()
    octave = _octave("--eval", "disp(version)").strip()
    return f"NLstep, {FUNCTION} with SHA-256 {digest}, under GNU Octave {octave}"


def integrate(function: Path, stated: Mapping[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Let NLstep integrate a `case`: displacement of node 1 at all times but the first, m, and any contact.

    Raises `RuntimeError` if the contact forces of a step did not converge.
    """
    with tempfile.TemporaryDirectory() as scratch:
        case_file, result_file = Path(scratch) / "case.mat", Path(scratch) / "result.mat"
        scipy.io.savemat(case_file, dict(stated))
        _octave(str(DRIVER), str(function.parent.absolute()), str(case_file), str(result_file))
        result = scipy.io.loadmat(result_file)
    if not result["converged"].item():
        raise RuntimeError("NLstep: the contact forces of a time step have not converged")
    return -result["inward"][0, 1:], result["in_contact"][0, 1:].astype(bool)


def _octave(*arguments: str) -> str:
    command = [OCTAVE, "--no-init-file", "--quiet", *arguments]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def table(config: Config, blade: ReducedBlade, function: Path, threads: int) -> pd.DataFrame:
    """Measure `CASES` by NLstep, `threads` at a time: the numbers of `direct`."""
    model = direct.unstiffened(blade)

    def measure(friction: float, n_modes: int, steps: int) -> pd.DataFrame:
        spec, name = direct.spec_of(config, blade, friction), f"rest_mu{friction:g}"
        displacement, in_contact = integrate(function, case(model, spec, n_modes, steps))
        numbers = of_displacement(name, displacement, spec.revolutions)[["number", "value", "unit"]]
        numbers.loc[len(numbers)] = [f"{name}.contact_share", in_contact.mean(), "1"]
        return numbers.assign(modes=n_modes, steps_per_revolution=steps)[COLUMNS]

    with ThreadPoolExecutor(threads) as pool:
        return pd.concat(pool.map(measure, *zip(*CASES, strict=True)), ignore_index=True)
