"""Arguments of the interface: lists in place of single values, and the error of one that cannot be used."""

import inspect
from collections.abc import Callable
from functools import wraps
from itertools import product
from typing import Any, TypeVar

import numpy as np

from bladerub.io.errors import BadInput, format_value

Function = TypeVar("Function", bound=Callable[..., Any])


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


def over(*names: str) -> Callable[[Function], Function]:
    """Let a function take lists (tuples, ranges, arrays) for the arguments `names`, and return a list then.

    It is called for each value; of several lists for each combination, the last argument varying fastest.
    `InputError` names an argument that is not of its class of the interface.
    """

    def decorate(function: Function) -> Function:
        signature = inspect.signature(function)
        kinds = {
            name: parameter.annotation
            for name, parameter in signature.parameters.items()
            if getattr(parameter.annotation, "__module__", "").startswith("bladerub.api.")
        }

        @wraps(function)
        def called(*args: Any, **kwargs: Any) -> Any:
            bound, results = signature.bind(*args, **kwargs), []
            arguments = bound.arguments
            for name, value in arguments.items():
                if name in names and isinstance(value, np.ndarray | np.generic):
                    arguments[name] = value.tolist()  # of no dimension: a number
            lists = {k: v for k, v in arguments.items() if k in names and isinstance(v, list | tuple | range)}
            for values in product(*lists.values()):
                arguments.update(zip(lists, values, strict=True))
                for name, kind in kinds.items():
                    if not isinstance(arguments[name], kind):
                        raise InputError(name, arguments[name], f"must be a {kind.__name__}")
                results.append(function(*bound.args, **bound.kwargs))
            return results if lists else results[0]

        return called  # type: ignore[return-value]

    return decorate
