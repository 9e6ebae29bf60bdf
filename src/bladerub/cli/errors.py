"""How a command says that what was asked for cannot be done."""

from bladerub.io.errors import BadInput


class InputError(BadInput):
    """Bad input of the command line, or of what it names."""
