"""Speed of a turbine's rotor over the wind beside that of a study's load cases."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import pandas as pd
import xarray as xr

from macroslip.constants import RPM
from macroslip.scada.bins import bin_centres, load_speeds
from macroslip.scada.reader import Scada
from macroslip.study.labels import events_of_runs
from macroslip.study.reader import open_study
from macroslip.study.weights import Weighting, stored_weighting

#: Difference from which on a note says so.
_MOST = 0.1
#: Columns of `speeds_beside`.
WIND = "wind_speed [m/s]"
MEASURED = "turbine [r/min]"
OF_STUDY = "study [r/min]"
SHARE = "share"


def speeds_beside(scada: Scada, study: xr.Dataset | str | PathLike[str]) -> pd.DataFrame:
    """Mean speed of the rotor in bins of wind speed, of a turbine and of a study's load cases.

    Parameters
    ----------
    scada : Scada
    study : xarray.Dataset or path
        From `open_study`, or its folder.

    Returns
    -------
    pandas.DataFrame
        A line for each bin that both have: `wind_speed [m/s]`, `turbine [r/min]`, mean of the rows
        in which the rotor turns, `study [r/min]`, mean of its runs, and `share` of those rows.
    """
    if not isinstance(study, xr.Dataset):
        study = open_study(Path(study))
    weighting = stored_weighting(study) or Weighting(scale=1.0, shape=2.0)
    width = weighting.width
    speeds = pd.DataFrame(
        {
            WIND: bin_centres(study[weighting.field].values, width),
            OF_STUDY: study["shaft_speed_mean"].values / RPM,
        }
    )
    is_wind = events_of_runs(study) == ""
    speeds = speeds[is_wind]
    turning = scada.turning[scada.kept].to_numpy()
    wind_of_rows = load_speeds(scada)[turning]
    rotor_speeds = scada.used_rows["rotor_speed"].to_numpy()[turning]
    measured = pd.DataFrame(
        {
            WIND: bin_centres(wind_of_rows, width),
            MEASURED: rotor_speeds / RPM,
        }
    )
    groups = measured.groupby(WIND)[MEASURED]
    table = groups.mean().to_frame()
    table[SHARE] = groups.size() / len(measured)
    table[OF_STUDY] = speeds.groupby(WIND)[OF_STUDY].mean()
    complete = table.dropna().reset_index()
    return complete.reindex(columns=[WIND, MEASURED, OF_STUDY, SHARE])


def speed_notes(table: pd.DataFrame) -> list[str]:
    """Bins in which the speeds of `speeds_beside` differ by more than a tenth, in a sentence."""
    differences = [
        f"{measured:.3g} against {of_study:.3g} at {wind:g} m/s"
        for wind, measured, of_study, _ in table.itertuples(index=False)
        if abs(measured / of_study - 1.0) > _MOST
    ]
    if not differences:
        return []
    return [
        "The rotor turns at another speed than that of the study's load cases, by more than 10 %: "
        f"{', '.join(differences)} (r/min)."
    ]
