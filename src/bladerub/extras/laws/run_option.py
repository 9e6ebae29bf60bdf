"""``bladerub run --law LAW``: another law of the elements than that of the config."""

import argparse
from typing import TYPE_CHECKING

from bladerub.cli import inputs
from bladerub.cli.run import RunOption
from bladerub.extras.law_settings import PARAMETER, law_parameters
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    from bladerub.api.study import Study
    from bladerub.settings.study import Config


class LawOption(RunOption):
    """The law and its parameters."""

    def add_to(self, parser: inputs.Parser) -> None:
        """Add ``--law`` and ``--law-parameter``."""
        text = "law of the elements by its name (docs/laws.md) or its file, instead of contact.law"
        parser.option("--law", text, metavar="LAW")
        text = "parameter of --law, SI units or with its unit; once for each of them"
        parser.option("--law-parameter", text, **PARAMETER)

    def check(self, options: argparse.Namespace, config: "Config") -> None:
        """Refuse a law of the rigid casing, and parameters of none."""
        if options.law is not None and options.coating == "rigid":
            raise BadInput(f"--law = {options.law}: goes with --coating abradable only")
        if law_parameters("--law-parameter", options.law_parameter) and options.law is None:
            raise BadInput(f"--law-parameter = {options.law_parameter[0]}: goes with --law only")

    def vary(self, options: argparse.Namespace, study: "Study") -> "Study":
        """Return the study with the law."""
        if options.law is None:
            return study

        from bladerub.extras.laws.interface import Law

        values = law_parameters("--law-parameter", options.law_parameter)
        with inputs.as_options():
            return study.with_law(Law(options.law, **values))
