"""Blades that were built outside of a study, such as those of the Python interface."""

import hashlib
import json
from contextlib import suppress
from pathlib import Path
from typing import Any

from bladerub.blade.files import made_from, recipe
from bladerub.blade.source import modules
from bladerub.io import atomic
from bladerub.io.folders import cache_folder
from bladerub.io.provenance import packages
from bladerub.io.sources import digest_behind
from bladerub.settings.blade import BladeSpec


def kept_at(config: BladeSpec) -> Path:
    """Return where a blade is, or would be, kept by all that determines it; raises as `made_from`."""
    return cache_folder() / "blades" / _name(config, made_from(config)) / "reduced_model.h5"


def _name(config: BladeSpec, origin: Any) -> str:
    content = [origin, digest_behind(*modules(config)), packages()]
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:16]


def kept_frequency(config: BladeSpec) -> float | None:
    """Return what `first_frequency` found before for the blade of `config`; None if it did not."""
    with suppress(OSError, ValueError):
        return float(_frequency_path(config).read_text(encoding="utf-8"))
    return None


def first_frequency(config: BladeSpec) -> float:
    """Return the rounded first frequency at rest, Hz, kept once found; raises as `frequency_at_rest`."""
    frequency = kept_frequency(config)
    if frequency is None:
        from bladerub.blade.build import frequency_at_rest  # imports the solver

        frequency = rounded_frequency(frequency_at_rest(config))
        with suppress(OSError), atomic.writing(_frequency_path(config)) as stream:
            stream.write(f"{frequency!r}\n")
    return frequency


def rounded_frequency(f1_hz: float) -> float:
    """Round a first frequency to the nine digits that do not depend on the machine, to normalise speeds."""
    return float(f"{f1_hz:.9g}")


def _frequency_path(config: BladeSpec) -> Path:
    # the reduction has no part in it at rest
    return cache_folder() / "frequencies" / _name(config, recipe(config.blade))
