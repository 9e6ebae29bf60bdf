"""The config of each sample of a design, and the blade that it needs."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.config import read as configuration
from bladerub.config.files import Located
from bladerub.extras.factors import lay_over
from bladerub.extras.robustness.plan import REFERENCE, REFERENCE_BATCH, Part, Plan
from bladerub.io.provenance import config_digest
from bladerub.study.grid import coating_cases

_DETERMINING = ("blade", "reduction", "contact", "coatings", "speeds", "solver", "analysis")  # and casings


# Threads take longer than the splines of a blade's sections
@threadpool_limits.wrap(limits=1, user_api="blas")
def check(study: Mapping[str, Any], plan: Plan) -> None:
    """Check every sample of every part; raises `ConfigError`, naming part and sample."""
    for part in plan.parts.values():
        for number, positions in enumerate(plan.positions()[: part.samples]):
            varied = _varied(study, plan, part, positions)
            configuration.validate(varied, f"parts.{part.name}, sample {number}")


def batch(study: Mapping[str, Any], plan: Plan, part: Part, name: str) -> dict[int, dict[str, Any]]:
    """Make the config of each sample of one job, by its number, without a check of its values.

    `name` is the number of the job, of `Part.batches`, or `REFERENCE_BATCH`, whose only sample has the
    study's own values. Raises `ConfigError` if a factor sets what the study does not have.
    """
    if name == REFERENCE_BATCH:
        return {REFERENCE: configuration.vary(study, part.study).plain()}
    samples, positions = part.batches()[int(name)], plan.positions()
    return {number: _varied(study, plan, part, positions[number]).plain() for number in samples}


def sample_digest(config: Mapping[str, Any]) -> str:
    """Digest those parts of its config that determine the findings of a sample."""
    used = {case.casing for case in coating_cases(config)}
    determining = {key: config[key] for key in _DETERMINING}
    determining["casings"] = {name: config["casings"][name] for name in sorted(used)}
    return config_digest(determining)


def blade_name(config: Mapping[str, Any]) -> str:
    """Name the blade of a sample; samples with equal blades have the same name."""
    return config_digest({key: config[key] for key in ("blade", "reduction")})[:12]


def _varied(study: Mapping[str, Any], plan: Plan, part: Part, positions: np.ndarray) -> Located:
    """Lay the part and the values of the sample at `positions` (d,) over the study."""
    return lay_over(configuration.vary(study, part.study), plan.factors, positions)
