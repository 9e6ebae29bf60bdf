"""Contact of a compressor blade with the abradable coating of its casing.

The Python interface: `load_study` or `default_study`, `build_blade`, `simulate` and `simulate_speeds`, and
`read_run`, `read_map` and `read_blade` for what a study has computed.

Data flows one way: ``blade → contact → study → plots``.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bladerub.api.blade import Blade, build_blade, read_blade
    from bladerub.api.ensemble import Ensemble, read_ensemble, simulate_ensemble
    from bladerub.api.errors import InputError
    from bladerub.api.fit import fit_coating
    from bladerub.api.law import Law
    from bladerub.api.map import Map, read_map, simulate_speeds
    from bladerub.api.rig import simulate_rig
    from bladerub.api.run import Run, read_run, simulate
    from bladerub.api.study import Study, StudyCoating, StudyRun, default_study, load_study
    from bladerub.config.errors import ConfigError
    from bladerub.contact.row_spec import Disk, Row, RowBlade
    from bladerub.extensions.rig.spec import Rig

__version__ = "0.1.0"

_MODULES = {
    "api.blade": ("Blade", "build_blade", "read_blade"),
    "api.ensemble": ("Ensemble", "read_ensemble", "simulate_ensemble"),
    "api.errors": ("InputError",),
    "api.fit": ("fit_coating",),
    "api.law": ("Law",),
    "api.map": ("Map", "read_map", "simulate_speeds"),
    "api.rig": ("simulate_rig",),
    "api.run": ("Run", "read_run", "simulate"),
    "api.study": ("Study", "StudyCoating", "StudyRun", "default_study", "load_study"),
    "config.errors": ("ConfigError",),
    "contact.row_spec": ("Disk", "Row", "RowBlade"),
    "extensions.rig.spec": ("Rig",),
}
_HOME = {name: f"bladerub.{module}" for module, names in _MODULES.items() for name in names}

__all__ = [
    "Blade",
    "ConfigError",
    "Disk",
    "Ensemble",
    "InputError",
    "Law",
    "Map",
    "Rig",
    "Row",
    "RowBlade",
    "Run",
    "Study",
    "StudyCoating",
    "StudyRun",
    "__version__",
    "build_blade",
    "default_study",
    "fit_coating",
    "load_study",
    "read_blade",
    "read_ensemble",
    "read_map",
    "read_run",
    "simulate",
    "simulate_ensemble",
    "simulate_rig",
    "simulate_speeds",
]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: the command line does without most of them."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
