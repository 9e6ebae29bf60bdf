"""Blades that were built outside of a study: those of the Python interface and of ``bladerub import``."""

import hashlib
import json
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from bladerub.blade import built
from bladerub.blade.build import build, is_built, made_from
from bladerub.blade.built import BuiltBlade
from bladerub.io.folders import cache_folder
from bladerub.io.provenance import packages, provenance
from bladerub.io.sources import builder_digest


def kept_at(config: Mapping[str, Any]) -> Path:
    """Return where the reduced blade of `config` is kept, whether it is there or not.

    The folder is named after all that determines the blade: its config, its file, the sources that build it,
    and the versions of the packages. Raises as `bladerub.blade.build.made_from`.
    """
    recipe = json.dumps([made_from(config), builder_digest(), packages()])
    name = hashlib.sha256(recipe.encode()).hexdigest()[:16]
    return cache_folder() / "blades" / name / "reduced_model.h5"


def keep(blade: BuiltBlade, config: Mapping[str, Any]) -> None:
    """Keep the blade of `config` for its study; raises OSError if it cannot be written."""
    path = kept_at(config)
    if not is_built(config, path):
        built.write(blade, provenance(config), *built.paths(path))


def kept_or_built(config: Mapping[str, Any]) -> BuiltBlade:
    """Return the blade of `config`: of another program, and kept, as it is kept; else built now.

    Raises as `bladerub.blade.build.build`.
    """
    if "source" in config["blade"]:
        with suppress(OSError):  # damaged: it is built again
            path = kept_at(config)
            if is_built(config, path):
                return built.read(path)
    return build(config)
