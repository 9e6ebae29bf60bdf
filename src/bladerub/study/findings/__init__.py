"""The paper's claims, each measured by a function of its own on the tables and maps of the study.

The claims C1 to C12 are in the order of the paper, a letter stands for a separately testable part. One that
speaks of coatings or speeds outside the study has no row: the log names it and what is missing.
"""

import logging
from collections.abc import Iterable
from dataclasses import asdict, fields

import pandas as pd

from bladerub.study.findings import moduli, tangential, wear_and_spectra
from bladerub.study.findings.claim import Claim, Finding, NotMeasurable, in_order
from bladerub.study.findings.evidence import Evidence

_REGISTERING = (moduli, tangential, wear_and_spectra)  # by their import

CLAIMS: tuple[Claim, ...] = in_order()  # every measurable part of every claim, in the order of the table
COLUMNS = ["id", *(field.name for field in fields(Finding))]  # columns of ``findings.csv``, see `Finding`

_log = logging.getLogger(__name__)


def judge(evidence: Evidence, claims: Iterable[Claim] = CLAIMS) -> pd.DataFrame:
    """Measure those `claims` that the `evidence` allows, a row each with `COLUMNS`; log the others."""
    rows = []
    for claim in claims:
        try:
            rows.append({"id": claim.id, **asdict(claim.measure(evidence))})
        except NotMeasurable as error:
            _log.warning("left out: %s: %s (%s)", claim.id, claim.statement, error)
    return pd.DataFrame(rows, columns=COLUMNS)
