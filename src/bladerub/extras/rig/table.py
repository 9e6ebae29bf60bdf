"""What rigs give, beside what was measured on them."""

from collections.abc import Iterable

import pandas as pd

from bladerub.extras.rig.passes import simulate_passes
from bladerub.extras.rig.spec import MEASURABLE, Rig


def table(rigs: Iterable[Rig]) -> pd.DataFrame:
    """Simulate the passes of rigs; a row each, with the ``rig`` and its ``element_law``."""
    tables = []
    for rig in rigs:
        passes = simulate_passes(rig)
        passes.insert(0, "rig", rig.name)
        passes.insert(1, "element_law", rig.law.label)
        tables.append(passes)
    return pd.concat(tables, ignore_index=True)


def compared(rigs: Iterable[Rig], passes: pd.DataFrame) -> pd.DataFrame:
    """Set the last pass of each rig beside what was measured: a row for each of `MEASURABLE`.

    ``computed`` and ``measured_on_rig`` are in the unit of the column; the latter is NaN where nothing was
    measured. ``assumed`` lists what the ``source`` does not give.
    """
    rows = []
    for rig in rigs:
        last = passes[passes.rig == rig.name].iloc[-1]
        for name in MEASURABLE:
            measured = rig.measured.get(name, float("nan"))
            rows.append((rig.name, name, last[name], measured, ", ".join(rig.assumed), rig.source))
    return pd.DataFrame(rows, columns=["rig", "quantity", "computed", "measured_on_rig", "assumed", "source"])
