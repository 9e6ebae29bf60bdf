"""Contact of a compressor blade with the abradable coating of its casing.

The Python interface: `load_study` or `default_study`, `build_blade` and `simulate`, and `read_run` and
`read_blade` for what a study has computed. Folders of `bladerub.extras` add more names, such as
`simulate_speeds` and `read_map` (`bladerub.plugins`).

Data flows one way: ``blade → contact → study → plots``.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from bladerub import plugins

if TYPE_CHECKING:
    from bladerub.api.arguments import InputError
    from bladerub.api.blade import Blade, build_blade, read_blade
    from bladerub.api.planned import StudyCoating, StudyRun
    from bladerub.api.run import Run, read_run
    from bladerub.api.simulate import simulate
    from bladerub.api.study import Study, default_study, load_study
    from bladerub.config.errors import ConfigError

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
_HOME = {name: f"bladerub.{module}" for module, names in _MODULES.items() for name in names}

__all__ = [
    "Blade",
    "ConfigError",
    "InputError",
    "Run",
    "Study",
    "StudyCoating",
    "StudyRun",
    "__version__",
    "build_blade",
    "default_study",
    "load_study",
    "read_blade",
    "read_run",
    "simulate",
]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: the command line does without most of them."""
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    if not name.startswith("_") and (place := plugins.offered("PUBLIC").get(name)):
        return getattr(plugins.load(place), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, *plugins.offered("PUBLIC")])
