"""Claim C1: the reduced model has the frequencies of the finite element model."""

from collections.abc import Sequence

from bladerub.study.findings.claim import Finding, NotMeasurable, below, claim
from bladerub.study.findings.evidence import Evidence

_FIRST_SIX = 'modes 1 to 6 agree (section "Reduced-order model and component mode synthesis", Fig. 2)'
_SEVENTH = "so does mode 7, the last the paper vouches for (Fig. 2): within two percent"


@claim("C1a", _FIRST_SIX, range(1, 7), 0.5)  # half a percent is the width of a line in the figure
@claim("C1b", _SEVENTH, [7], 2.0)
def worst_error(evidence: Evidence, modes: Sequence[int], percent: float) -> Finding:
    """Largest relative error of the frequencies of `modes` at all speeds."""
    table = evidence.rom_accuracy[evidence.rom_accuracy["mode"].isin(modes)]
    if table["mode"].nunique() < len(modes):
        raise NotMeasurable(f"rom_accuracy has not all of the modes {min(modes)} to {max(modes)}")
    worst = 100 * float(table.relative_error.abs().max())
    which = "mode 7" if len(modes) == 1 else f"modes {min(modes)} to {max(modes)}"
    text = f"reduced model predicts {which} at all speeds: largest error (Fig. 2)"
    return Finding(text, f"below {percent:g}", worst, "%", *below(worst, percent, 4 * percent))
