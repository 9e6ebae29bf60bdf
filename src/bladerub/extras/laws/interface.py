"""The law of the abradable elements, by name or from a file."""

from collections.abc import Mapping
from types import MappingProxyType

from bladerub.api.arguments import InputError
from bladerub.contact.spec import ElementLaw
from bladerub.extras.law_reading import law_of
from bladerub.extras.law_settings import law_entry


class Law:
    """How the elements of a coating deform and wear, for `Study.with_law`.

    Parameters
    ----------
    name : str
        ``"plastic"`` (the paper's), ``"perfectly_plastic"``, ``"viscoplastic"``, ``"brittle"`` or
        ``"thermal"``; or the path of a Python file with a law of your own, which ends in ``.py``.
    **parameters : float or str
        A value for each parameter of the law, in SI units or text with a unit, such as ``"10 kPa s"``.

    Raises
    ------
    InputError
        If there is no such law or file, or a parameter is missing, unknown or out of its range.

    Examples
    --------
    >>> import bladerub as br
    >>> law = br.Law("viscoplastic", viscosity=1e4)
    >>> law
    Law('viscoplastic', viscosity=10000.0)
    >>> law.parameters["viscosity"]  # Pa s
    10000.0
    >>> br.Law("viscoplastic", viscosity="10 kPa s") == law
    True
    >>> law.name, sorted(law.entry)
    ('viscoplastic', ['name', 'viscosity'])
    >>> law.element_law.label
    'viscoplastic (viscosity 10000)'
    """

    def __init__(self, name: str, **parameters: float | str):
        self._entry = law_entry(str(name), parameters)
        try:
            self._described = law_of(self._entry)
        except ValueError as error:
            raise InputError("law", name, str(error)) from None

    @property
    def name(self) -> str:
        """Name of the law; of one's own, that of its file without the suffix."""
        return self._described.name

    @property
    def parameters(self) -> Mapping[str, float]:
        """Value of each parameter, SI units."""
        return MappingProxyType(dict(self._described.parameters))

    @property
    def element_law(self) -> ElementLaw:
        """The law as a `bladerub.Rig` takes it."""
        return self._described

    @property
    def entry(self) -> dict[str, str | float]:
        """The law as ``contact.law`` of a config."""
        return {**self._entry, **self.parameters}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Law) and self._described == other._described

    def __hash__(self) -> int:
        return hash(self._described)

    def __repr__(self) -> str:
        values = (f", {name}={value!r}" for name, value in self.parameters.items())
        return f"Law({self._entry.get('file', self.name)!r}{''.join(values)})"
