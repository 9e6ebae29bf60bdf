"""The table of the peaks: every coating at the engine orders of its casing."""

from collections.abc import Iterable

import pandas as pd

from bladerub.settings.study import Config
from bladerub.study import peaks
from bladerub.study.maps import CoatingMap
from bladerub.study.orders import peak_settings
from bladerub.study.variants import with_variant


def table(config: Config, maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Find the peaks of every coating: a row each, with `bladerub.study.peaks.COLUMNS`, see `with_variant`.

    Where a peak is missing, f_peak and amplitude are NaN and the table has the column ``reason``. Raises
    `ValueError` as `bladerub.study.peaks.peak`.
    """
    rows = []
    for coating in maps:
        settings = peak_settings(config, coating.case.casing)
        rows += [peaks.row(coating, order, settings) for order in settings.orders]
    return with_variant(pd.DataFrame(rows), peaks.COLUMNS, "reason")
