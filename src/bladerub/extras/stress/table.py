"""Table of the largest stress of the blade at the peaks of the study."""

from pathlib import Path

import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.extras.stress.run import BladeStress
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.variants import filled, with_variant

_CASE = ("casing", "E", "K", "theta", "law")
_PEAK = ("order", "f_peak", "amplitude")
_OF_LAST = ("von_mises", "von_mises_x", "von_mises_y", "von_mises_z", "principal", "alternating")

COLUMNS = [*_CASE, *_PEAK, "status", "rotation_von_mises", "start_up_von_mises"]
COLUMNS += [f"last_{name}" for name in _OF_LAST]
"""Columns of ``stress.csv``, described in ``columns.csv``."""


@threadpool_limits.wrap(limits=1, user_api="blas")  # the products are small
def table(mesh: str | Path, blade: ReducedBlade, config: Config, peaks: pd.DataFrame) -> pd.DataFrame:
    """Find the stress of the run at each of the `peaks`, a table ``peaks.csv``.

    A row each, with `COLUMNS`, see `with_variant`.

    `mesh` is the ``mesh.h5`` of the blade. Raises `BadInput` where it is of matrices alone, which tell of no
    stress.
    """
    stress, rows = BladeStress(mesh, blade), []
    for peak in filled(peaks).dropna(subset=["f_peak"]).to_dict("records"):
        spec = run_spec(config, CoatingCase.described(peak), peak["f_peak"])
        result, run_stress = stress.of_run(spec, config.analysis.spectrum_revolutions)
        rows.append({name: peak[name] for name in (*_CASE, "variant", *_PEAK)} | {"status": result.status})
        if run_stress:
            rows[-1]["rotation_von_mises"] = run_stress.static["von_mises"]
            rows[-1]["start_up_von_mises"] = run_stress.start_up.get("von_mises")
            rows[-1] |= {f"last_{name}": run_stress.last[name] for name in _OF_LAST}
    return with_variant(pd.DataFrame(rows, columns=[*COLUMNS, "variant"]), COLUMNS)
