"""The files of a blade, and what they were built from; importing this loads nothing of the builder."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bladerub.blade.model import N_INTERFACE
from bladerub.blade.source import reader
from bladerub.io import hdf5
from bladerub.settings.blade import Blade, BladeSpec


def mesh_path(reduced_model: Path) -> Path:
    """Return the file of the mesh that belongs to the reduced model in the file `reduced_model`."""
    return reduced_model.with_name("mesh.h5")


def accuracy_path(reduced_model: Path) -> Path:
    """Return the table of the accuracy of the reduced model in the file `reduced_model`."""
    return reduced_model.with_name("rom_accuracy.csv")


def missing_file(reduced_model: Path) -> Path | None:
    """Return the first of the files of a blade, whose reduced model is `reduced_model`, that is not there."""
    paths = reduced_model, mesh_path(reduced_model), accuracy_path(reduced_model)
    return next((path for path in paths if not path.exists()), None)


def made_from(config: BladeSpec) -> str:
    """Write down what of `config` determines the blade: equal for two configs of the same blade.

    Raises OSError or ValueError if a file that the blade comes from cannot be read or is missing.
    """
    parts = {"blade": recipe(config.blade), "reduction": without_defaults(config.reduction.plain())}
    return json.dumps(parts, sort_keys=True)


def without_defaults(reduction: Mapping[str, Any]) -> dict[str, Any]:
    """Return the block ``reduction`` without what it would be just the same if it were left out."""
    defaults = {"fit_speeds": 3, "interface_nodes": N_INTERFACE}
    return {key: value for key, value in reduction.items() if value != defaults.get(key)}


def recipe(blade: Blade) -> dict[str, Any]:
    """Return what of the block ``blade`` determines the blade; raises as `made_from`."""
    source = reader(blade)
    return source.recipe(blade) if source else blade.plain()


def is_built(config: BladeSpec, path: Path) -> bool:
    """Return whether all files of the blade at `path` are there and of `config`, as its mesh states."""
    if missing_file(path):
        return False
    return hdf5.read_attributes(mesh_path(path)).get("made_from") == made_from(config)
