"""The error of an input of the interface."""

from typing import Any

from bladerub.io.errors import BadInput, format_value


class InputError(BadInput):
    """An argument that cannot be used: its `name`, its `value` in words and what would be `right`.

    Examples
    --------
    >>> import bladerub as br
    >>> str(br.InputError("K", -1.0, "must be above 0"))
    'K = -1: must be above 0'
    """

    def __init__(self, name: str, value: Any, right: str):
        self.name, self.right = name, right
        self.value = f"{value:g}" if isinstance(value, float) else format_value(value)
        super().__init__(f"{name} = {self.value}: {right}")
