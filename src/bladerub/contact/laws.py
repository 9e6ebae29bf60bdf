"""Laws of an abradable element, motions of the tip, and the time loop that is compiled with them.

The paper's law is `bladerub.contact.law`, its tip has eight nodes that move, and the loop that is imported by
name is theirs. Other laws, more nodes and a further motion plug in (``VARIANTS`` of `bladerub.plugins`):
``law`` reads laws, ``loop`` imports the modules of the loop again.

A further motion is how the tip may move besides, by a further coordinate of each node (``MOTIONS``). A folder
that adds one has two modules. ``motion`` has `further`, the coordinates from those of the blade, and
`stiffness`, what the coating sets against them. ``kernel`` has functions that the time loop has in the place
of its own where the tip moves so (`module_for`).
"""

import importlib
import math
from types import ModuleType
from typing import Any

import numpy as np

from bladerub import plugins
from bladerub.contact.spec import PLASTIC, Coating, ElementLaw, RunSpec
from bladerub.io.sources import digest_behind, digest_of
from bladerub.numerics.lanes import USUAL
from bladerub.settings.fields import Section

NAMES = (PLASTIC.name, *sorted(plugins.offered("LAWS")))  # laws that a config may name

_MOTION = "tip_turns"  # of the block contact of the config

_ALONE = {
    "law": f"name: this package has the law {PLASTIC.name} alone",
    "loop": f"this package has tips of up to {USUAL} nodes alone, which do not turn, and the paper's law",
}


def solver_digest() -> str:
    """Digest the source of what computes a run: it is valid for this alone, and so is the machine code."""
    return digest_of("contact", "numerics", "blade/model.py")


def element_law(law: Section | None) -> ElementLaw:
    """Describe the block ``contact.law``, the paper's for none; ValueError, key first, where it is wrong."""
    is_paper = law is None or law.plain() in ({}, {"name": PLASTIC.name})
    return PLASTIC if is_paper else _plugged_in("law").law_of(law.plain())


def source_of(law: ElementLaw) -> str:
    """Return the text of the module of a law; it is empty for that of the paper, which the loop has."""
    return "" if law == PLASTIC else _plugged_in("law").source_of(law)


def law_digest(law: ElementLaw) -> dict[str, str]:
    """Digest what the spec of a run and the sources of the loop lack of a law; nothing of the paper's."""
    return {} if law == PLASTIC else _plugged_in("law").law_digest(law)


def compile_error(law: ElementLaw, error: Exception) -> Exception:
    """Return what to raise where the compiler refuses a law with this error."""
    return _plugged_in("law").compile_error(law, error)


def module_of(law: ElementLaw) -> ModuleType:
    """Return the module of a law, whose functions are those of `bladerub.contact.law`."""
    return module_for(USUAL, "contact.law", law)


def module_for(lanes: int, name: str, law: ElementLaw = PLASTIC, turns: bool = False) -> ModuleType:
    """Return the module `name` of the time loop, such as ``contact.kernel.loop``, for vectors of `lanes`.

    `turns` asks for the further motion. A module that builds on the loop may be asked for as well. Raises
    `ValueError` if the law cannot be run, or the package is without that motion.
    """
    if lanes == USUAL and law == PLASTIC and not turns:
        return importlib.import_module(f"bladerub.{name}")
    further = f"{_motion_folder()}.kernel" if turns else ""
    return _plugged_in("loop").module_for(lanes, name, source_of(law), further)


def element_parameters(coating: Coating, area: np.ndarray, time_step: float = math.inf) -> np.ndarray:
    """Return the parameters (p, n) of elements of cross-sections `area` (n,), m², by the coating's law."""
    parameters = module_of(coating.element_law).element(coating, area, time_step)
    return np.array([np.broadcast_to(value, area.shape) for value in parameters], dtype=float)


def motion() -> Any:
    """Return the module of the motion; raises `ValueError` where the package is without it."""
    return plugins.load(f"{_motion_folder()}.motion")


def motion_digest(spec: RunSpec) -> dict[str, str]:
    """Digest what the loop lacks of the motion in a run, as ``motion``; nothing of the paper's."""
    if not spec.turns:
        return {}
    folder = _motion_folder()
    return {"motion": digest_behind(f"{folder}.kernel", f"{folder}.motion")}


def _motion_folder() -> str:
    """Name the folder of the motion."""
    if _MOTION not in (offered := plugins.offered("MOTIONS")):
        raise ValueError(f"contact.{_MOTION} = true: this package is without that motion, must be false")
    return offered[_MOTION]


def _plugged_in(kind: str) -> Any:
    if place := plugins.offered("VARIANTS").get(kind):
        return plugins.load(place)
    raise ValueError(_ALONE[kind])
