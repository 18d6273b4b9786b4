"""Results to report on, from a file or a folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.files import check_regular
from macroslip.hdf5_file import check_hdf5
from macroslip.result.stored import REMEDY, check_result

if TYPE_CHECKING:
    import xarray as xr


def read_results(path: Path) -> dict[str, xr.Dataset]:
    """The datasets of a netCDF file, or of all netCDF files in a folder, by the name of the file.

    Parameters
    ----------
    path : Path
        A file that `macroslip run` wrote, or a folder of such files; subfolders are not searched.

    Raises
    ------
    InputError
        If there is no such path, the folder holds no netCDF file, or a file cannot be read or holds no result.
    """
    path = Path(path)
    if not path.exists():
        raise InputError("there is no such file or folder", where=str(path), remedy="Name what macroslip run wrote.")
    files = sorted(path.glob("*.nc")) if path.is_dir() else [path]
    if not files:
        raise InputError(
            "the folder holds no netCDF file", where=str(path), allowed="files that macroslip run wrote (*.nc)"
        )
    for file in files:
        check_regular(file, REMEDY)
    check_hdf5(files, REMEDY)
    return {file.stem: _read(file) for file in files}


def _read(file: Path) -> xr.Dataset:
    import xarray as xr

    try:
        # Units of seconds are units, not times of day.
        found = xr.load_dataset(file, engine="h5netcdf", decode_times=False)
    except (OSError, ValueError, KeyError) as error:
        raise InputError(
            f"the file cannot be read as netCDF ({error})",
            where=str(file),
            remedy=REMEDY,
        ) from None
    check_result(found, str(file))
    return found
