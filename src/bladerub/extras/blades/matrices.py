"""From mass and stiffness of another program to a blade that can be reduced."""

from typing import NamedTuple

import numpy as np
from scipy.linalg import eigvalsh_tridiagonal
from scipy.sparse import csc_array, eye_array, kron
from scipy.sparse.linalg import ArpackError, norm
from scipy.spatial.distance import cdist
from threadpoolctl import threadpool_limits

from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.linear import lowest_modes
from bladerub.blade.mesh import LENGTH_TOLERANCE, BladeMesh, FreeCoordinates, MeshedBlade, check_length
from bladerub.blade.reduction import fit_speeds
from bladerub.extras.blade_meshes import NodeCloud
from bladerub.extras.blades import matrix_folder, origin, rigid_body
from bladerub.extras.blades.importing import measured
from bladerub.extras.blades.matrix_folder import FIT, MASS, NODES
from bladerub.extras.blades.origin import Frame, naming
from bladerub.extras.blades.settings import Source
from bladerub.io.errors import BadInput
from bladerub.settings.blade import Reduction
from bladerub.settings.study import Config

# N/m of the stiffness, and equally kg of the mass, by the name of a system of units with the second in it. As
# the two are equal, frequencies do not show when the wrong system is named.
_UNITS = {"SI": 1.0, "mm-tonne": 1e3, "inch-lbf": 4.4482216152605 / 0.0254}
_PENALTY = 1e4  # diagonal entry over the median, from which on a coordinate is held
_STEPS = 60  # of Lanczos's method
_ROUNDING = 1e-10  # of the largest eigenvalue
_ENERGY = 1e-13  # of what would be there if nothing cancelled; 1e-8 in the first mode of a thin blade
OMEGA_TOLERANCE = 1e-3  # relative, of the speed of the files to that of the config


class ImportedMatrices(NamedTuple):
    """A blade from the matrices of another program."""

    blade: DiscreteBlade
    mass: float  # of the rigid blade, kg
    mass_is_complete: bool  # whether the files have rows of the clamped nodes, whose mass is missing else
    wave_speed: float  # of its material, along the blade, m/s
    half_speed_change: float  # of the stiffness to half the highest speed, over that to the highest; ~ 1/4

    @property
    def is_rooted(self) -> bool:
        """Whether clamped nodes are listed, so that the length is known."""
        return self.blade.layout.mesh.root.size > 0


@threadpool_limits.wrap(limits=1)
def import_matrices(source: Source, reduction: Reduction) -> ImportedMatrices:
    """Read matrices that have coordinates enough for the modes; a BadInput names file and fault."""
    f_max, n_modes = reduction.f_omega_max, reduction.accuracy_modes
    folder, frame = origin.path(source), origin.frame(source)
    unit = _UNITS[source.matrix_units or "SI"]
    with naming(folder):
        names = matrix_folder.files(folder)
        at_speeds = matrix_folder.speeds(names, fit_speeds(f_max))
    with naming(names["nodes"]):
        nodes = matrix_folder.read_nodes(names["nodes"])
        layout = _layout(nodes, frame, source.tip_cone)
        free = FreeCoordinates(len(nodes.points), nodes.clamped)
        n_internal = free.free.size - 3 * nodes.interface.size
        n_required = max(n_modes, reduction.modes_per_speed)
        if n_internal <= n_required:
            rule = f"must have more than {n_required}, the modes that are wanted"
            raise ValueError(f"has {n_internal} free coordinates off the interface; {rule}")

    n, n_all = free.free.size, 3 * free.n_nodes
    rotation = kron(eye_array(n // 3), frame.turn, format="csc")
    rule = f"must have three rows for each of the {free.n_nodes} nodes of {NODES} ({n_all})"
    rule += f", or for each that is not clamped ({n})" if n < n_all else ""

    def read(name: str) -> tuple[csc_array, csc_array]:
        """Read a matrix, and from it that of the free coordinates, in the blade's axes and SI units."""
        with naming(names[name]):
            whole = matrix_folder.read_matrix(names[name])
            if whole.shape[0] not in (n, n_all):
                raise ValueError(f"is {whole.shape[0]} x {whole.shape[0]}; {rule}")
            matrix = whole[free.free][:, free.free] if whole.shape[0] > n else whole
            return whole, csc_array(unit * (rotation @ matrix @ rotation.T))

    mass_of_all, mass = read(MASS)
    stiffness = {f_omega: read(name)[1] for f_omega, name in at_speeds.items()}
    stiffness_rest, stiffness_half, stiffness_max = (stiffness[f_omega] for f_omega in fit_speeds(f_max))

    # the matrices are those of one body, which is held
    with naming(names[MASS], names[FIT[0]]):
        rigid_body.check_joined(mass, stiffness_rest)
    numbers, points = free.free[::3] // 3, layout.mesh.mesh.points
    rows, places = numbers + 1, points[numbers]
    with naming(names[MASS]):
        check_definite(mass)
        rigid_body.check_mass(mass, rows)
    with naming(names[FIT[0]]):
        check_definite(stiffness_rest)
        frequency, modes = _modes(stiffness_rest, mass, n_modes)
        check_held(stiffness_rest, modes[:, 0])

    # mass and stiffness at rest have the order of the nodes
    with naming(names["nodes"]):
        rigid_body.check_places(stiffness_rest, places, rows)
    with naming(names[FIT[0]]):
        interface = np.searchsorted(numbers, layout.mesh.interface)
        rigid_body.check_stiffness(stiffness_rest, places, rows, points[layout.mesh.root], interface)
    with naming(names[MASS]):
        rigid_body.check_same_nodes(mass, stiffness_rest, rows)

    frequencies = {0.0: frequency}
    for f_omega, name in list(at_speeds.items())[1:]:
        with naming(names[name]):
            rigid_body.check_change(stiffness[f_omega], stiffness_rest, rows)
            check_definite(stiffness[f_omega])
            frequencies[f_omega], _ = _modes(stiffness[f_omega], mass, n_modes)
            if frequencies[f_omega][0] <= 0:  # so near to zero that few of Lanczos's steps do not show it
                raise ValueError("is not positive definite: a mode of the blade is unstable at this speed")
    if source.omega_max is not None:
        fastest = source.omega_max / (2 * np.pi * frequency[0])
        if abs(fastest / f_max - 1) > OMEGA_TOLERANCE:
            raise BadInput(
                f"{folder}: omega_max = {source.omega_max:g} rad/s is {fastest:.6g} of the blade's first "
                f"frequency, {frequency[0]:.6g} Hz; reduction.f_omega_max = {f_max:g} must be that"
            )

    change = norm(stiffness_max - stiffness_rest)
    half_change = float(norm(stiffness_half - stiffness_rest) / change) if change else 0.0
    is_complete = nodes.clamped.size > 0 and mass_of_all.shape[0] == 3 * len(nodes.points)
    wave_speed = _wave_speed(stiffness_rest, mass, layout, free)
    blade = DiscreteBlade(layout, free, mass, stiffness, {}, frequencies, frequency, modes)
    return ImportedMatrices(blade, unit * _rigid_mass(mass_of_all), is_complete, wave_speed, half_change)


def of_length(config: Config) -> DiscreteBlade:
    """Import the matrices that `config` names; BadInput as `import_matrices`, or if it has another length."""
    length, folder = config.blade.length, origin.path(config.blade.source)
    imported = import_matrices(config.blade.source, config.reduction)
    layout = imported.blade.layout
    tip_radius = np.hypot(*layout.mesh.mesh.points[layout.mesh.tip, 1:].T).mean()
    if imported.is_rooted:
        check_length(length, layout.length, folder)
    elif not (1 - LENGTH_TOLERANCE) * layout.length <= length < tip_radius:
        reach = f"whose nodes reach over {layout.length:.4g} m up to a tip at a radius of {tip_radius:.4g} m"
        raise BadInput(f"blade.length = {length:g}: must be that of the blade in {folder}, {reach}")
    return imported.blade


def _modes(stiffness: csc_array, mass: csc_array, n_modes: int) -> tuple[np.ndarray, np.ndarray]:
    try:
        return lowest_modes(stiffness, mass, n_modes)
    except (np.linalg.LinAlgError, ArpackError) as error:
        raise ValueError(f"is singular ({error}); are the clamped nodes marked?") from error


def _layout(nodes: matrix_folder.Nodes, frame: Frame, tip_cone: float | None) -> MeshedBlade:
    """Convert the nodes to the blade's frame, and check that the interface is that of a tip."""
    points = frame.metres(nodes.points)
    radius = np.hypot(points[:, 1], points[:, 2])
    ends = points[nodes.interface]
    if radius[nodes.interface].min() <= 0:
        raise ValueError("an interface node lies on the engine axis, which must pass through the origin")
    twins = np.argwhere(np.triu(cdist(ends, ends) == 0, k=1))
    if len(twins):
        first, second = twins[0] + 1
        raise ValueError(f"interface nodes {first} and {second} are in one place")
    if frame.downstream_x * (ends[-1, 0] - ends[0, 0]) <= 0:
        rule = f"must be at the leading edge: is downstream = {frame.downstream} the direction of the flow?"
        raise ValueError(f"interface node 1 is downstream of node {len(ends)}; {rule}")
    tip_nodes = nodes.tip if nodes.tip.size else nodes.interface
    mesh = BladeMesh(NodeCloud(points), nodes.clamped, tip_nodes, nodes.interface)
    return measured(mesh, frame, tip_cone)


def _rigid_mass(mass: csc_array) -> float:
    """Mass of the rigid body, the mean of the three directions."""
    rigid = np.tile(np.eye(3), (mass.shape[0] // 3, 1))
    return float(np.trace(rigid.T @ (mass @ rigid)) / 3)


def _wave_speed(stiffness: csc_array, mass: csc_array, layout: MeshedBlade, free: FreeCoordinates) -> float:
    """Speed (m/s) of waves in the material: root of the energy of a blade stretched evenly, over its mass."""
    along = layout.mesh.mesh.points[:, 2]
    stretched = np.zeros(3 * len(along))
    stretched[2::3] = along - (along[layout.mesh.root].mean() if layout.mesh.root.size else along.min())
    stretched = stretched[free.free]
    diagonal = stiffness.diagonal()
    stretched[diagonal > _PENALTY * np.median(diagonal)] = 0.0
    return float(np.sqrt(stretched @ (stiffness @ stretched) / _rigid_mass(mass)))


def check_definite(matrix: csc_array) -> None:
    """Raise ValueError if a symmetric matrix has an entry on its diagonal or an eigenvalue below zero."""
    diagonal = matrix.diagonal()
    low = np.flatnonzero(diagonal <= 0)
    if low.size:
        fault = f"its entry ({low[0] + 1}, {low[0] + 1}) is {diagonal[low[0]]:.3g}"
        raise ValueError(f"is not positive definite: {fault}; must be above 0")
    # Ritz values of Lanczos's method lie between the eigenvalues: a negative one is proof. Eigenvalues near
    # zero may stay unnoticed (see `check_held`)
    n, scale = diagonal.size, 1 / np.sqrt(diagonal)
    vector = np.random.default_rng(0).standard_normal(n)
    vector /= np.linalg.norm(vector)
    before, beta = np.zeros(n), 0.0
    alphas, betas = [], []
    for _ in range(min(_STEPS, n)):
        residual = scale * (matrix @ (scale * vector)) - beta * before
        alphas.append(residual @ vector)
        residual -= alphas[-1] * vector
        beta = np.linalg.norm(residual)
        betas.append(beta)
        if beta <= _ROUNDING * abs(alphas[0]):
            break
        before, vector = vector, residual / beta
    ritz = eigvalsh_tridiagonal(np.array(alphas), np.array(betas[:-1]))
    if ritz.min() < -_ROUNDING * np.abs(ritz).max():
        raise ValueError("is not positive definite: it has negative eigenvalues")


def check_held(stiffness: csc_array, mode: np.ndarray) -> None:
    """Raise ValueError if the energy of the lowest `mode` of a stiffness is negative or only rounding."""
    size = np.abs(mode)
    if mode @ (stiffness @ mode) <= _ENERGY * (size @ (abs(stiffness) @ size)):
        fault = "is singular or indefinite: its lowest mode moves the blade without resistance"
        raise ValueError(f"{fault}; mark the clamped nodes, or leave their rows out")
