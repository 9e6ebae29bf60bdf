"""One statement of the paper beside what this model shows."""

from __future__ import annotations

from dataclasses import dataclass

YES, PARTLY, NO = "yes", "partly", "no"


@dataclass(frozen=True)
class Finding:
    """One row of ``findings.csv``.

    Parameters
    ----------
    id : str
        Claim and part, for instance ``C4a``.
    claim : str
        The paper's statement, with its figure.
    paper : float or str
        What the paper says, in `unit`.
    measured : float or str
        The same, of this model.
    unit : str
        Unit of `paper`, `measured` and `margin`; ``"1"`` for pure numbers and normalised speeds.
    holds : str
        ``yes``, ``partly`` or ``no``.
    margin : float
        Distance of `measured` from the border between yes and not yes, positive on the side of yes; NaN when
        there is nothing to measure a distance from.
    """

    id: str
    claim: str
    paper: float | str
    measured: float | str
    unit: str
    holds: str
    margin: float


class NotMeasurable(Exception):
    """The study has not the runs that a claim speaks of; the message says which."""


def below(value: float, yes: float, partly: float) -> tuple[str, float]:
    """Judge a value that should be small: yes up to `yes`, partly up to `partly`.

    Returns
    -------
    holds : str
        The verdict.
    margin : float
        ``yes - value``.
    """
    return (YES if value <= yes else PARTLY if value <= partly else NO), yes - value


def above(value: float, yes: float, partly: float) -> tuple[str, float]:
    """Judge a value that should be large: yes from `yes`, partly from `partly` (see `below`)."""
    holds, margin = below(-value, -yes, -partly)
    return holds, margin
