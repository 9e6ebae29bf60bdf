"""A law of the elements put to random histories of depth, to see whether it does what a law must.

1. *Numbers*: forces, wear, stiffness and energies are finite.
2. *Contact*: an element only pushes, and only where it is touched; its wear never shrinks.
3. *Monotone*: the deeper it is pressed, the greater its force and its wear.
4. *Agreement*: the stiffness is the derivative of the force, as far as the law says that it is constant, or
   at the depth alone to a per cent; the elastic force at the depth that is left by wear is the force.
5. *Energy*: what work goes into an element is stored or dissipated, and no cycle gives back more than it
   takes.
6. Where the law has a strength that heat lowers, it is 1 in the cold, never rises with the temperature and
   stays above 0.
7. It can be compiled with the time loop.
"""

import itertools
from collections.abc import Sequence
from dataclasses import replace
from types import ModuleType

import numpy as np

from bladerub.contact.laws import element_parameters, module_of
from bladerub.contact.setup import compile_kernel
from bladerub.contact.spec import Coating, ElementLaw
from bladerub.extras.user_code import bounded
from bladerub.io.errors import BadInput

TIME_STEPS = (1e-7, 1e-6, 1e-5)  # of the histories, s: those of runs, and ten times longer and shorter
LONGEST_CHECK = 120.0  # s after which a law is taken for endless; that of the package takes a second or two
HISTORIES = 40  # for each coating and time step
ENERGY = 1e-3
"""Part of the work exchanged that may be missing, beside what is unsure in steps within which contact or flow
begins or ends: the work there is between that of the force before and that of the force after."""

_AREA = 1e-6  # m²
_CORNERS, _STEPS, _LOOK_EVERY = 8, 500, 31
_SHALLOW, _DEEP = 1e-4, 0.3  # range of the deepest points, layer thicknesses
_ROUNDING = 1e-9


class LawReport:
    """Outcome of a check: histories that the law was put to, and the first place of each of its problems."""

    def __init__(self):
        self.histories = 0
        self.problems: dict[str, str] = {}

    def unless(self, condition: np.ndarray, what: str, **values: np.ndarray) -> None:
        """Note the first history in which something is not right, with what it is there in SI units."""
        wrong = ~np.broadcast_to(condition, (HISTORIES,))
        if wrong.any():
            history = int(wrong.argmax())
            readings = (
                f"{name} {np.broadcast_to(value, wrong.shape)[history]:.4g}" for name, value in values.items()
            )
            self.problems.setdefault(what, ", ".join(name.replace("_", " ") for name in readings))


def check_law(law: ElementLaw, coatings: Sequence[Coating], seed: int = 0) -> LawReport:
    """Press unworn elements of layered `coatings` along random histories; what a law raises is a problem."""
    rng, log = np.random.default_rng(seed), LawReport()
    try:
        module = module_of(law)
        for specimen in (replace(coating, element_law=law) for coating in coatings):
            for time_step in TIME_STEPS:
                with np.errstate(all="ignore"), bounded("one of its functions", LONGEST_CHECK):
                    _follow(module, specimen, time_step, rng, log)
                log.histories += HISTORIES
            if hasattr(module, "strength"):
                with bounded("strength", LONGEST_CHECK):
                    _heat(module, specimen, log)
        if not log.problems:
            compile_kernel(law=law)
    except Exception as error:  # whatever the law, or the compiler of it, may raise
        first_line = str(error).strip().partition("\n")[0]
        kind = "" if isinstance(error, BadInput) else f"{type(error).__name__}: "
        log.problems.setdefault("it cannot be run", f"{kind}{first_line}")
    return log


def _paths(thickness: float, rng: np.random.Generator) -> np.ndarray:
    """Draw depths below the unworn surface (m): straight between corners, out of contact at both ends."""
    deepest = thickness * np.exp(rng.uniform(np.log(_SHALLOW), np.log(_DEEP), HISTORIES))
    corners = rng.uniform(-0.1, 1.0, (_CORNERS + 1, HISTORIES)) * deepest
    corners[[0, -1]] = -0.1 * deepest
    abscissa = np.arange(_CORNERS * _STEPS + 1) / _STEPS
    return np.stack([np.interp(abscissa, np.arange(_CORNERS + 1), path) for path in corners.T], axis=1)


def _follow(
    law: ModuleType, coating: Coating, time_step: float, rng: np.random.Generator, log: LawReport
) -> None:
    """Press elements along histories and look at each step."""
    element = law.Element(*element_parameters(coating, np.array([_AREA]), time_step)[:, 0])
    twice = element_parameters(coating, _AREA * np.array([1.0, 2.0]), time_step)
    single = element_parameters(coating, np.array([2 * _AREA]), time_step)
    if not np.allclose(twice, np.column_stack([element, single]), rtol=1e-9, atol=0.0):
        what = "element gives parameters that depend on the areas of other elements"
        log.problems.setdefault(what, "areas 1 and 2 mm²")
    paths = _paths(coating.thickness, rng)
    wear, force, stored, dissipated, work, exchanged, unsure, increment = np.zeros((8, HISTORIES))
    for step, (penetration_before, penetration) in enumerate(itertools.pairwise(paths)):
        depth, force_before, increment_before = penetration - wear, force, increment
        force, increment = law.return_mapping(element, depth, wear)
        loss = law.dissipated_energy(element, wear, increment, force_before, force)
        stored = law.stored_energy(element, force)
        values = {"depth": depth, "worn": wear, "force": force, "wear": increment}
        finite = np.isfinite(force + increment + loss + stored)
        log.unless(finite, "it gives what is no number", **values)
        if not finite.all():
            return
        log.unless(increment >= 0, "wear is negative", **values)
        log.unless(force >= 0, "an element pulls", **values)
        log.unless((depth > 0) | (force == 0) & (increment == 0), "a force without contact", **values)
        least_loss = -_ROUNDING * np.abs(force * coating.thickness)
        log.unless(loss >= least_loss, "energy is dissipated below 0", **values)
        if step % _LOOK_EVERY == 0:
            _look(law, element, depth, wear, force, increment, rng, log)
        advance = penetration - penetration_before
        step_work = 0.5 * (force + force_before) * advance
        work, exchanged = work + step_work, exchanged + np.abs(step_work)
        bends = ((force > 0) != (force_before > 0)) | ((increment > 0) != (increment_before > 0))
        unsure = unsure + np.where(bends, 0.5 * np.abs((force - force_before) * advance), 0.0)
        dissipated, wear = dissipated + loss, wear + increment
        if (step + 1) % _STEPS == 0:
            missing, allowed = work - stored - dissipated, ENERGY * exchanged + unsure
            energies = {"work": work, "stored": stored, "dissipated": dissipated}
            for is_right, what in (
                (missing <= allowed, "energy is lost: some of the work is neither stored nor dissipated"),
                (missing >= -allowed, "energy is created: more is stored and dissipated than the work"),
                (work >= -allowed, "energy is created: a cycle gives back more than it takes"),
            ):
                log.unless(is_right, what, **energies)


def _heat(law: ModuleType, coating: Coating, log: LawReport) -> None:
    """Look at the strength over the temperature."""
    rise = np.concatenate([[0.0], np.geomspace(1e-2, 1e4, 600)])
    strength = np.broadcast_to(law.strength(coating, rise), rise.shape)
    falls = np.concatenate([[strength[0] == 1.0], np.diff(strength) <= 0]) & (strength > 0)
    if not falls.all():  # also what is no number
        index = int(falls.argmin())
        what = "strength is not 1 without heat, rises with the temperature or is not above 0"
        log.problems.setdefault(what, f"temperature rise {rise[index]:.4g}, strength {strength[index]:.4g}")


def _look(law, element, depth, wear, force, increment, rng, log: LawReport) -> None:
    """Look at force and wear at other depths than those of a step."""
    scale = np.abs(depth) + wear
    small = _ROUNDING * element.elastic * scale
    by = scale * 10 ** rng.uniform(-4, 0, HISTORIES)
    deeper_force, deeper_increment = law.return_mapping(element, depth + by, wear)
    values = {"depth": depth, "worn": wear, "force": force}
    rises = (deeper_force >= force - small) & (deeper_increment >= increment - _ROUNDING * scale)
    log.unless(rises, "force or wear falls as the depth grows", **values, deeper_by=by, to=deeper_force)
    elastic_force = law.elastic_force(element, depth - increment, wear + increment)
    is_force = np.abs(elastic_force - force) <= small
    log.unless(is_force, "elastic_force after wear is not the force", **values, elastic=elastic_force)
    slope, linear = law.tangent(element, depth, wear)
    finite = np.isfinite(slope) & np.isfinite(linear)
    log.unless(finite, "it gives what is no number", **values, stiffness=slope, constant_over=linear)

    def forces(step: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        above, below = (law.return_mapping(element, depth + sign * step, wear)[0] for sign in (1, -1))
        return above, below

    what = "tangent is not the derivative of the force, as far as it says"
    values["stiffness"] = slope
    for part in (0.5, 0.99):
        step = np.minimum(part * linear, scale)
        wide = step > 1e-6 * scale  # else rounding would count
        above, below = forces(step)
        error = np.abs(above - below - 2 * step * slope)
        log.unless(~wide | (error <= 1e-6 * element.elastic * step + small), what, **values, over=step)
    step = 1e-5 * scale
    above, below = forces(step)
    ahead, behind = (above - force) / step, (force - below) / step
    margin = 1e-2 * np.maximum(np.abs(ahead), np.abs(behind)) + small / step
    between = (slope >= np.minimum(ahead, behind) - margin) & (slope <= np.maximum(ahead, behind) + margin)
    log.unless((linear > step) | (step == 0) | between, what, **values, over=linear)
