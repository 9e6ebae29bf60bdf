"""The paper's statements: each testable part is measured by a function that `claim` registers."""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

YES, PARTLY, NO = "yes", "partly", "no"
SCORE = {YES: 1.0, PARTLY: 0.5, NO: 0.0}  # a verdict as a number


@dataclass(frozen=True)
class Finding:
    """What this model shows of one part of a claim: a row of ``findings.csv`` without its id."""

    claim: str  # the paper's statement as measured, with its figure
    paper: float | str  # what the paper says, in `unit`
    measured: float | str  # the same, of this model
    unit: str  # "1" for pure numbers and normalised speeds
    holds: str  # yes, partly or no
    margin: float  # of `measured` to the border between yes and not yes, positive if yes; NaN if it has none
    measured_by_harmonic: float | str = ""  # of a claim on lobes: `measured` by the strongest harmonic
    holds_by_harmonic: str = ""  # its verdict; no threshold decides which harmonic is the strongest

    def beside(self, by_harmonic: "Finding") -> "Finding":
        """Add what the strongest harmonic of the wear shows to what the lobes show."""
        return replace(self, measured_by_harmonic=by_harmonic.measured, holds_by_harmonic=by_harmonic.holds)


class NotMeasurable(Exception):
    """The study lacks the runs that a claim speaks of; the message says which."""


class Claim(NamedTuple):
    """A separately testable part of a statement: its id, what it says, and what measures it on `Evidence`."""

    id: str
    statement: str
    measure: Callable[[Any], Finding]


REGISTERED: dict[str, Claim] = {}  # the claims by id, in the order of their registration


def claim(id_: str, statement: str, *arguments: Any) -> Callable[[Callable], Callable]:
    """Register a function ``measure(evidence, *arguments)`` as the measurement of a claim.

    The `id_` is letters, a number and, for one of several parts, a letter: ``C4a``; the `statement` is what
    the paper says, and where. One function may measure several claims, with other `arguments` each. Raises
    `ValueError` if the id has another form or is taken.
    """
    _place(id_)
    if id_ in REGISTERED:
        raise ValueError(f"claim {id_} is registered twice")

    def register(measure: Callable) -> Callable:
        REGISTERED[id_] = Claim(id_, statement, lambda evidence: measure(evidence, *arguments))
        return measure

    return register


def in_order() -> tuple[Claim, ...]:
    """Return all claims by number and part, which is the order of the paper."""
    return tuple(sorted(REGISTERED.values(), key=lambda part: _place(part.id)))


def claim_of(id_: str) -> str:
    """Return the claim that ``C2a`` is a part of: ``C2``."""
    letters, number, _ = _place(id_)
    return f"{letters}{number}"


def _place(id_: str) -> tuple[str, int, str]:
    parts = re.fullmatch(r"([A-Z]+)(\d+)([a-z]?)", id_)
    if parts is None:
        raise ValueError(f"claim {id_}: an id is letters, a number and at most one letter, such as C4a")
    return parts[1], int(parts[2]), parts[3]


def ratio(value: Any, to: float, label: str) -> Any:
    """Divide amplitudes; raises `NotMeasurable`, which names them by `label`, where the second is none."""
    if not to > 0:
        raise NotMeasurable(f"{label}: an amplitude of {to:g} m is nothing to compare with")
    return value / to


def below(value: float, yes: float, partly: float) -> tuple[str, float]:
    """Judge a value that should be small, yes up to `yes`, partly up to `partly`: verdict and margin."""
    exact = round(value, 9)  # 0.31 - 0.30 is above 0.01 in binary numbers
    return (YES if exact <= yes else PARTLY if exact <= partly else NO), yes - value


def above(value: float, yes: float, partly: float) -> tuple[str, float]:
    """Judge a value that should be large, yes from `yes`, partly from `partly`: verdict and margin."""
    return below(-value, -yes, -partly)
