"""Claim C1: the reduced model has the frequencies of the finite element model."""

from __future__ import annotations

from bladerub.study.findings.evidence import Evidence
from bladerub.study.findings.finding import Finding, NotMeasurable, below

READS = ("mode", "relative_error")
"""What is read here of the table ``rom_accuracy``."""


def first_six_modes(evidence: Evidence) -> Finding:
    """C1a: modes 1 to 6 agree (section "Reduced-order model and component mode synthesis", Fig. 2).

    Half a percent is the width of a line in the figure.
    """
    return _worst_error(evidence, "C1a", range(1, 7), 0.5)


def seventh_mode(evidence: Evidence) -> Finding:
    """C1b: so does mode 7, the last the paper vouches for (Fig. 2): within two percent."""
    return _worst_error(evidence, "C1b", [7], 2.0)


def _worst_error(evidence: Evidence, id_: str, modes: range | list[int], percent: float) -> Finding:
    table = evidence.rom_accuracy
    errors = table[table["mode"].isin(modes)].relative_error.abs()
    if table[table["mode"].isin(modes)]["mode"].nunique() < len(modes):
        raise NotMeasurable(f"rom_accuracy has not all of the modes {min(modes)} to {max(modes)}")
    worst = 100 * float(errors.max())
    holds, margin = below(worst, percent, 4 * percent)
    which = "mode 7" if len(modes) == 1 else f"modes {min(modes)} to {max(modes)}"
    claim = f"reduced model predicts {which} at all speeds: largest error (Fig. 2)"
    return Finding(id_, claim, f"below {percent:g}", worst, "%", holds, margin)
