"""From the variables of our files to xarray."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from bladerub.io.hdf5 import Variable
from bladerub.io.optional import package

if TYPE_CHECKING:
    import xarray as xr


def to_dataset(variables: Mapping[str, Variable], attributes: Mapping[str, Any]) -> "xr.Dataset":
    """Return variables with their units as xarray opens them from a file that holds them."""
    arrays = {
        name: (
            variable.dims,
            np.asarray(variable.data),
            {"units": variable.units, "long_name": variable.long_name},
        )
        for name, variable in variables.items()
    }
    return package("xarray", "xarray").Dataset(arrays, attrs=dict(attributes))
