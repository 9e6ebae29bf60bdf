"""A study: its config, and the coatings and runs that it has or can be asked for."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np

from bladerub.api.arguments import InputError, over
from bladerub.api.display import Shown
from bladerub.api.planned import Quantity, StudyCoating, StudyRun, checked_number
from bladerub.blade.cache import kept_frequency
from bladerub.config import read as configuration
from bladerub.config.checks import own_problem
from bladerub.config.files import Located
from bladerub.config.quantities import in_typed_unit
from bladerub.io.folders import CONFIG, ROOT, base_config, study_folder
from bladerub.settings.coatings import History, HistoryOfDirectContact, HistoryWithFriction, OnCasing
from bladerub.settings.study import Config, defaults, required, typed
from bladerub.settings.units import moduli_in_words, pressure_in_words, speeds_in_words
from bladerub.study import grid


@dataclass(frozen=True, repr=False)
class Study(Shown):
    """A study: everything that its config says.

    Parameters
    ----------
    config : Config
        The config, checked, its keys as attributes as in ``config/config.yaml``: SI units, or as said there.
    folder : Path
        Folder of the study. Paths of the config are relative to it.

    Examples
    --------
    >>> import bladerub as br
    >>> study = br.default_study()
    >>> len(study.coatings), study.speeds[[0, -1]].tolist()
    (63, [0.02, 0.4])
    >>> study.coating("2nd", E=1.1, K=0.5).name == study.coating("2nd", E="660 MPa", K="300 MPa").name
    True
    >>> study.coating("2nd", E=1.1, K=0.5, damping_ratio=1e-3).name
    '2nd_E1.1_K0.5_theta0_xi0.001'
    >>> study.rigid("2nd", friction=0.1).name
    '2nd_rigid_mu0.1'
    >>> len(study.run("2nd", E=[1, 2, 4], K=0.5, f_omega=[0.19, 0.2]))
    6
    >>> study.replace("contact.damping_ratio", 1e-3).config.contact.damping_ratio
    0.001
    >>> study.replace({"solver": {"revolutions": 40}, "results": "results/longer"}).results.name
    'longer'
    >>> br.Study.from_settings({"solver": {"revolutions": 40}}).config.solver.revolutions
    40
    """

    config: Config = field(repr=False)
    folder: Path

    @classmethod
    def from_settings(cls, settings: Mapping[str, Any]) -> "Study":
        """Return the study of nested values as `load_study` does that of a file; raises as `replace`."""
        if isinstance(settings, Mapping) and required() <= settings.keys():
            return cls(configuration.validate({**defaults(), **settings}), study_folder())
        return cls(configuration.read(base_config()), study_folder()).replace(settings)

    @property
    def results(self) -> Path:
        """Folder of the results of the workflow."""
        return self.folder / self.config.results

    def with_law(self, law: Any) -> "Study":
        """Return this study with another `law` of the abradable elements, for all its coatings.

        Its ``entry`` is the block ``contact.law`` of a config.
        """
        if not hasattr(law, "entry"):
            raise InputError("law", law, "must be a Law")
        values = self.config.plain()
        values["contact"]["law"] = law.entry
        return replace(self, config=typed(values))

    def replace(self, settings: str | Mapping[str, Any], value: Any = None) -> "Study":
        """Return this study with other values in its config, checked as a whole.

        `settings` are a key with dots, as in messages, whose value `value` is; or nested values as in a
        config file, which are laid over those of this study. Raises `ConfigError` with a line for each
        problem: key, value and what would be right.
        """
        if isinstance(settings, str):
            for name in reversed(settings.split(".")):
                value = {name: value}
            settings = value
        if not isinstance(settings, Mapping):
            raise InputError("settings", settings, "must be a key with dots, or nested values")
        overlay = Located.of(settings)
        return replace(self, config=configuration.validate(configuration.vary(self.config, overlay)))

    @property
    def coatings(self) -> list[StudyCoating]:
        """Coatings that the study lists."""
        return [StudyCoating(self.config, case) for case in grid.coating_cases(self.config)]

    @property
    def speeds(self) -> np.ndarray:
        """Speeds (n,) of the study, ascending, normalised."""
        return np.array(grid.speeds(self.config))

    @over("E", "K", "theta", "friction", *grid.OWN)
    def coating(
        self,
        casing: str,
        *,
        E: Quantity,
        K: Quantity,
        theta: Quantity | None = None,
        friction: float | None = None,
        damping_ratio: Quantity | None = None,
        layer_thickness: Quantity | None = None,
        interference: Quantity | None = None,
    ) -> StudyCoating:
        """Describe an abradable coating, which need not be one that the study lists.

        A list for any number gives a list of coatings, with several lists one for each combination.

        Parameters
        ----------
        casing : str
            Name of a casing of the config, for instance ``"2nd"``.
        E, K : float or str
            Young modulus and plastic modulus, normalised, or text with a unit such as ``"1.2 GPa"``. So may
            be all others; docs/config.md has the units.
        theta : float, optional
            Angle of the abradable elements, rad: the contact force has this constant direction. Default 0.
        friction : float, optional
            Instead of `theta`: coefficient of Coulomb friction, opposed to the sliding of each node.
        damping_ratio : float, optional
            Of every mode, instead of that of the config.
        layer_thickness, interference : float, optional
            Of the coating and of casing and blade, m, as and instead of those of the config.

        Raises
        ------
        InputError
            If a value is not possible; the message says which and what would be right.
        """
        if friction is not None and theta is not None:
            raise InputError("friction", friction, "goes without theta, which says the same")
        own = {
            "damping_ratio": damping_ratio,
            "layer_thickness": layer_thickness,
            "interference": interference,
        }
        if friction is None:
            return self._checked(History, casing, own, E=E, K=K, theta=0.0 if theta is None else theta)
        return self._checked(HistoryWithFriction, casing, own, E=E, K=K, friction=friction)

    @over("friction", "damping_ratio", "interference")
    def rigid(
        self,
        casing: str,
        *,
        friction: float = 0.0,
        damping_ratio: Quantity | None = None,
        interference: Quantity | None = None,
    ) -> StudyCoating:
        """Describe direct contact with the rigid casing by Coulomb's law; the rest is as of `coating`."""
        own = {"damping_ratio": damping_ratio, "interference": interference}
        return self._checked(HistoryOfDirectContact, casing, own, friction=friction)

    @over("E", "K", "f_omega", "theta", "friction", "revolutions", *grid.OWN)
    def run(
        self,
        casing: str,
        *,
        E: Quantity,
        K: Quantity,
        f_omega: Quantity,
        theta: Quantity | None = None,
        friction: float | None = None,
        revolutions: int | None = None,
        damping_ratio: Quantity | None = None,
        layer_thickness: Quantity | None = None,
        interference: Quantity | None = None,
    ) -> StudyRun:
        """Describe the run of an abradable coating at one speed; see `coating` and `StudyCoating.at`."""
        coating = self.coating(
            casing,
            E=E,
            K=K,
            theta=theta,
            friction=friction,
            damping_ratio=damping_ratio,
            layer_thickness=layer_thickness,
            interference=interference,
        )
        return coating.at(f_omega, revolutions)

    def _checked(
        self, kind: type[OnCasing], casing: str, own: Mapping[str, Quantity | None], **values: Quantity
    ) -> StudyCoating:
        """Describe the coating of an entry of this kind; what is None in `own` is that of the config."""
        if not isinstance(casing, str) or casing not in self.config.casings:
            close = get_close_matches(str(casing), self.config.casings, n=1)
            hint = f"; did you mean {close[0]}?" if close else ""
            raise InputError("casing", casing, f"must be one of {', '.join(self.config.casings)}{hint}")
        values |= {name: value for name, value in own.items() if value is not None}
        plain: Any = {name: checked_number(self.config, name, value) for name, value in values.items()}
        case = grid.listed_case(kind.model_construct(casing=casing, **plain))
        if case.variant and (problem := own_problem(self.config, case)):
            name, right = problem
            right = in_typed_unit(f"must be {right}", values[name], plain[name])
            raise InputError(name, values[name], right)
        return StudyCoating(self.config, case)

    def _shown(self) -> tuple[str, Mapping[str, str]]:
        config = self.config
        return "Study", {
            "casings": ", ".join(config.casings),
            "coatings": f"{len(self.coatings)}{moduli_in_words(grid.young_moduli(config))}",
            "E = 1, K = 1": pressure_in_words(grid.modulus_unit(config)),
            "speeds": speeds_in_words(grid.speeds(config), kept_frequency(config)),
            "revolutions": f"{config.solver.revolutions}",
            "results": f"{self.results}",
        }


def load_study(*paths: str | Path) -> Study:
    """Read the config of a study and check it.

    Parameters
    ----------
    *paths : path-like
        A whole config, such as ``config/config.yaml``, and files laid over it in order. Files that change
        only some keys, such as ``config/quick.yaml``, are laid over the config of the study at work
        (`bladerub.io.folders.study_folder`), or of the paper if there is none. A path is looked for in the
        working directory, then in the folder of the study, then among the configs of the package.

    Raises
    ------
    ConfigError
        With a line for each problem: file, line, key, value and what would be right.

    Examples
    --------
    >>> import bladerub as br
    >>> br.load_study().config.solver.revolutions
    20
    """
    base = base_config()
    laid_over = [path for path in map(_found, paths) if path.resolve() != base.resolve()]
    if laid_over and configuration.is_whole(laid_over[0]):
        base = laid_over.pop(0)
    return Study(configuration.read(base, *laid_over), study_folder())


def default_study() -> Study:
    """Return the study of the paper, which comes with the package.

    Examples
    --------
    >>> import bladerub as br
    >>> sorted(br.default_study().config.casings)
    ['2nd', '2nd5nd']
    """
    return Study(configuration.read(ROOT / CONFIG), study_folder())


def settings_of(*configs: Config | None) -> Config:
    """Return the first of the `configs` that there is, or that of the study at work."""
    config = next(filter(None, configs), None) or load_study().config
    if not isinstance(config, Config):
        raise InputError("config", config, "must be the config of a Study")
    return config


def _found(path: str | Path) -> Path:
    places = (folder / path for folder in (Path(), study_folder(), ROOT))
    return next((place for place in places if place.is_file()), Path(path))
