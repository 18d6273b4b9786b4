"""Whether a dataset has what the tables of variables say of it."""

import xarray as xr

from macroslip.variables import VariableTable


def check_variables(dataset: xr.Dataset, *tables: VariableTable) -> None:
    """Every variable of a dataset has a row of its dimensions, unit and meaning in one of the tables."""
    for name, values in dataset.data_vars.items():
        rows = [table[name] for table in tables if name in table]
        assert len(rows) == 1, f"{name} has {len(rows)} rows"
        (row,) = rows
        assert values.dims == row.dims, f"{name} is over {values.dims}, not {row.dims}"
        assert values.attrs["units"] == row.units, name
        assert values.attrs["long_name"] == row.long_name, name
