"""The runs of a study one by one, for what draws some of them."""

from typing import Any, NamedTuple

from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, coating_cases, speed_name, speeds
from bladerub.study.solver import row_of


class StudyRun(NamedTuple):
    """One point of the study's grid, a coating at a normalised speed; or a row of blades on it."""

    case: CoatingCase
    f_omega: float
    row: Any = None
    row_name: str = ""

    @property
    def name(self) -> str:
        """Path of the run's file below ``runs``, without its suffix: ``2nd_E2_K0.5_theta0/0.1900``."""
        return self.row_name or f"{self.case.name}/{speed_name(self.f_omega)}"


def study_runs(config: Config) -> list[StudyRun]:
    """List every run of the study."""
    row = row_of(config)
    return [StudyRun(case, f_omega, row) for case in coating_cases(config) for f_omega in speeds(config)]
