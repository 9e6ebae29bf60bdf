"""How a command says that what was asked for cannot be done."""


class InputError(ValueError):
    """Bad input; the message is one line that says what would be right."""
