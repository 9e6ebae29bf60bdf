"""What ``bladerub run`` can be asked for besides a run (``RUN_OPTIONS`` of `bladerub.plugins`)."""

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from bladerub.cli.inputs import Parser

if TYPE_CHECKING:
    from bladerub.api.blade import Blade
    from bladerub.api.planned import StudyRun
    from bladerub.api.run import Run
    from bladerub.api.study import Study
    from bladerub.settings.study import Config


class RunOption:
    """Options of the command and what they do, step by step; each step does nothing unless defined."""

    units: ClassVar[Mapping[str, str]] = {}  # of the figures that it adds

    def add_to(self, parser: Parser) -> None:
        """Add the options to those of the command."""

    def check(self, options: argparse.Namespace, config: "Config") -> None:
        """Check and convert the options; raises `bladerub.io.errors.BadInput`."""

    def vary(self, options: argparse.Namespace, study: "Study") -> "Study":
        """Return the study as the options change it."""
        return study

    def arguments(self, options: argparse.Namespace) -> dict[str, Any]:
        """Return what `bladerub.simulate` is given besides."""
        return {}

    def figures(
        self, options: argparse.Namespace, planned: "StudyRun", blade: "Blade", run: "Run"
    ) -> dict[str, Any]:
        """Return what is reported of the `run` besides its own figures."""
        return {}

    def in_words(self, figures: Mapping[str, Any]) -> list[str]:
        """Write these of all figures as lines; none if they are not there."""
        return []
