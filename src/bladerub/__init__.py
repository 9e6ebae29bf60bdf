"""Contact of a compressor blade with the abradable coating of its casing.

The Python interface: `load_study` or `default_study`, `build_blade` and `simulate`, and `read_run` and
`read_blade` for what a study has computed. Folders of `bladerub.extras` add more names, such as
`simulate_speeds` and `read_map` (`bladerub.plugins`).

Data flows one way: ``blade → contact → study → plots``.
"""

from typing import TYPE_CHECKING, Any

from bladerub import plugins

if TYPE_CHECKING:  # exported by their aliases
    from bladerub.api.arguments import InputError as InputError
    from bladerub.api.blade import Blade as Blade
    from bladerub.api.blade import build_blade as build_blade
    from bladerub.api.blade import read_blade as read_blade
    from bladerub.api.planned import StudyCoating as StudyCoating
    from bladerub.api.planned import StudyRun as StudyRun
    from bladerub.api.run import Run as Run
    from bladerub.api.run import read_run as read_run
    from bladerub.api.simulate import simulate as simulate
    from bladerub.api.study import Study as Study
    from bladerub.api.study import default_study as default_study
    from bladerub.api.study import load_study as load_study
    from bladerub.config.errors import ConfigError as ConfigError

__version__ = "0.1.0"

_MODULES = {
    "api.arguments": ("InputError",),
    "api.blade": ("Blade", "build_blade", "read_blade"),
    "api.planned": ("StudyCoating", "StudyRun"),
    "api.run": ("Run", "read_run"),
    "api.simulate": ("simulate",),
    "api.study": ("Study", "default_study", "load_study"),
    "config.errors": ("ConfigError",),
}
_PLACES = {name: module for module, names in _MODULES.items() for name in names}

__all__ = ["__version__", *_PLACES]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: the command line does without most of them."""
    places = _PLACES if name in _PLACES or name.startswith("_") else plugins.offered("PUBLIC")
    if name in places:
        return getattr(plugins.load(places[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, *plugins.offered("PUBLIC")])
