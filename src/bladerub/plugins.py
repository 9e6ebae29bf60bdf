"""What the folders of `bladerub.extras` add to the package; each may be deleted, and none is named elsewhere.

A folder says what it adds in its ``plugin.py``, which imports nothing: each value is a module below
`bladerub`, or ``module:object``.

=============== ===================================================================================
``PUBLIC``      names of the Python interface, each with its module
``COMMANDS``    commands of ``bladerub``, each with the module whose `add_to` names its options
``RUN_OPTIONS`` what ``bladerub run`` can be asked for besides: classes as `bladerub.cli.run.RunOption`
``MANIFESTS``   rows of the manifests in folders of a name, for checks of all files
``INVENTORIES`` what counts runs beside those of the coatings, for ``bladerub status``
``FAULTS``      what finds damaged, lost and unreadable files of results, for ``bladerub status --thorough``
``MEASURES``    what a run may be asked for besides itself, each with its module
``SOURCES``     keys of ``blade.source`` of the config, each with its module (`bladerub.blade.source`);
                what the config says below one is in ``SECTIONS``
``REDUCTIONS``  what reduces a blade to a tolerance, by that key of ``reduction`` of the config
``DOUBTS``      what doubts the frequencies of a blade: functions as `bladerub.blade.frequencies.doubts`
``CASINGS``     casings that are no sum of nodal diameters, by the key of the config that describes them
``LAWS``        laws of the coating by name, each with the module for the loop (`bladerub.contact.laws`)
``VARIANTS``    what reads laws (``law``), and what imports the time loop again with another law of the
                coating or for more nodes (``loop``): modules (`bladerub.contact.laws`)
``MOTIONS``     how the tip may move besides its nodes, by the key of the config (`bladerub.contact.laws`)
``ROWS``        what computes rows of blades, by the key of the config that describes them
``DATASETS``    what a run file may hold besides that of a single blade: a dictionary as of the store
``SOLVERS``     what computes runs instead of the processor, by the name in ``solver.device``
``COATINGS``    functions of a config that list coatings which are run on request besides its own
``COSTS``       what further jobs of a coating cost: functions of config and coating that return a number of
                runs at its speeds, by the name of the rule
``SCHEDULES``   what divides the cores among the jobs: functions of a config that return what has `threads`
                of a rule, a coating and cores (or None), and `priority`, below 1, of a coating
``SECTIONS``    keys of the config by their path, such as ``blade.source``, each with its type: a model
                or an annotated type (`bladerub.settings.fields`). One with a default is in every config,
                and one below another that plugs in is a key of that. ``casings.<key>`` is a kind of
                casing with that key
``AGREEMENTS``  functions that yield the problems of a config that has a section, by its name
                (`bladerub.config.checks.reads`)
``NOTES``       functions that list what is worth knowing of a valid config, a line each
``FORECASTS``   what says how much a plan of Snakemake computes, and how long: modules with `announce` and
                `announce_at_exit`
``BARS``        what shows the runs of a job as they are done: classes of the name of a coating and the folder
                of its runs, with `show` for each (`bladerub.study.job.RunDone`) and `close`
``RECORDS``     what remembers the config of results: a module with `notes`, called when an invocation is
                planned with the folder of its results and what is laid over the config, `start`, called at
                its start with Snakemake's ``workflow`` as well, and `read_config` for commands that name none
``REMEDIES``    what cures Snakemake: modules with `begin`, called when an invocation is planned, and
                `start`, called at its start with Snakemake's ``workflow`` and the folders of its results
``NEEDS``       names of other folders, without which a folder adds nothing
=============== ===================================================================================
"""

import re
from collections.abc import Iterator
from difflib import get_close_matches
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

EXTRAS = Path(__file__).parent / "extras"

# none where Python drops docstrings
_KINDS = re.findall(r"^``([A-Z_]+)``", __doc__ or "", re.MULTILINE)


class MissingPart(ImportError):
    """What a ``plugin.py`` adds and is not there, or cannot be added; the message names it."""


@cache
def offered(kind: str) -> dict[str, str]:
    """Where to find what folders add of a kind, by name; raises `MissingPart` if two add the same name."""
    places: dict[str, str] = {}
    for plugin in _plugins():
        added = getattr(plugin, kind, {})
        for name in added.keys() & places.keys():
            raise MissingPart(f"{plugin.__file__}: {kind}: {name}: is added as {places[name]} already")
        places |= added
    return places


def load(place: str) -> Any:
    """Import a module, or an object of one, by its place; raises `MissingPart` if it is not there."""
    module, _, name = place.partition(":")
    module = f"bladerub.{module}"
    try:
        loaded = import_module(module)
    except ModuleNotFoundError as error:
        if error.name and f"{module}.".startswith(f"{error.name}."):
            raise MissingPart(f"{module}: no such module, {_added_by(place)}") from error
        raise
    if name and not hasattr(loaded, name):
        raise MissingPart(f"{module}: has no {name}, {_added_by(place)}")
    return getattr(loaded, name) if name else loaded


def loaded(kind: str) -> dict[str, Any]:
    """Import all that is offered of a kind, by name."""
    return {name: load(place) for name, place in offered(kind).items()}


def refusal(kind: str, name: str, reason: str) -> MissingPart:
    """Make the error of something that is there, and cannot be added."""
    return MissingPart(f"bladerub.{offered(kind)[name]}: {reason}")


def files(name: str) -> list[Path]:
    """Return the files of a name, such as ``columns.csv``, in the folders."""
    return sorted(EXTRAS.glob(f"*/{name}"))


def _added_by(place: str) -> str:
    """Name the file that adds a place, or something else of its module."""
    added = f'"{place.partition(":")[0]}'
    adding = (path for path in EXTRAS.glob("*/plugin.py") if added in path.read_text(encoding="utf-8"))
    return f"which {next(adding, 'the plugin.py of a folder in src/bladerub/extras')} adds"


def _plugins() -> Iterator[Any]:
    for path in sorted(EXTRAS.glob("*/plugin.py")):
        plugin = import_module(f"bladerub.extras.{path.parent.name}.plugin")
        if all((EXTRAS / name).is_dir() for name in getattr(plugin, "NEEDS", ())):
            _check(plugin)
            yield plugin


def _check(plugin: Any) -> None:
    """Raise `MissingPart` where a ``plugin.py`` has an unknown kind, or one that is no dictionary."""
    for kind in filter(str.isupper, vars(plugin)):
        setting = f"{plugin.__file__}: {kind}"
        if _KINDS and kind not in _KINDS:
            (close,) = get_close_matches(kind, _KINDS, 1, cutoff=0)
            raise MissingPart(f"{setting}: unknown, did you mean {close}?")
        if kind != "NEEDS" and not isinstance(getattr(plugin, kind), dict):
            raise MissingPart(f"{setting}: must be a dictionary of names, each with its place")
