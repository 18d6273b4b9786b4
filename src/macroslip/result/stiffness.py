"""Stiffness of a main bearing about operating points, for programs of drivetrain and rotor dynamics.

Five degrees of freedom of the inner ring in the bearing frame: displacements along X0, Y0, Z0 [m]
and tilts about X0, Y0 [rad], at the bearing's centre. Forces and moments are those that the shaft
puts on the ring, so that ΔF = K Δu.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

import macroslip
from macroslip.arrays import FloatArray
from macroslip.bearing import Bearing
from macroslip.case.case import Case
from macroslip.errors import InputError, MacroslipError
from macroslip.kinds import kind_of
from macroslip.loads import RollerLoads
from macroslip.loads.source_file import without_folders
from macroslip.lubricant import Lubricant
from macroslip.ring.balance import RingGeometry, balance, tangent_stiffness
from macroslip.roller.model import ring_geometry, roller_model
from macroslip.variables import ALWAYS, Variable, VariableTable

LOADS = ("F_X0", "F_Y0", "F_Z0", "M_X0", "M_Y0")
MOTIONS = ("d_X0", "d_Y0", "d_Z0", "tilt_X0", "tilt_Y0")
#: Units of the stiffness, by rows of loads and columns of motions.
UNITS = tuple(
    tuple(
        f"{'N' if load.startswith('F') else 'N m'}/{'m' if motion.startswith('d') else 'rad'}"
        for motion in MOTIONS
    )
    for load in LOADS
)
#: Places of the rollers within a pitch over which the stiffness is averaged.
_POSITIONS = 16
#: Part of the load that may be left unbalanced.
_UNBALANCED = 1e-8
#: Smallest over largest eigenvalue of the stiffness of displacements from which on rollers hold the
#: ring.
_HELD = 1e-9


#: All variables of `ring_stiffness`.
STIFFNESS = VariableTable(
    "Stiffness of a bearing, `macroslip.result.stiffness.ring_stiffness`",
    (
        Variable("force", ("point", "axis"), "N", ALWAYS, "load on the ring"),
        Variable(
            "displacement",
            ("point", "axis"),
            "m",
            ALWAYS,
            "displacement of the inner ring, mean over a pitch of the rollers",
        ),
        Variable(
            "stiffness",
            ("point", "load", "motion"),
            "see units",
            ALWAYS,
            "change of the load on the inner ring with its motion, at the bearing's centre",
        ),
        Variable(
            "variation",
            ("point",),
            "1",
            ALWAYS,
            "largest change of an entry over a pitch, over the largest entry",
        ),
        Variable(
            "held",
            ("point",),
            "1",
            ALWAYS,
            "1 where loaded rollers hold the ring in every direction",
        ),
    ),
)


def ring_stiffness(cases: Mapping[str, Case]) -> xr.Dataset:
    """Stiffness of the main bearing about the mean and the extreme loads of cases.

    Parameters
    ----------
    cases : mapping
        Cases by name, of double-row spherical roller bearings with loads at the hub or on the
        bearing.

    Returns
    -------
    xarray.Dataset
        Over `point`, three a case (mean load, least and largest radial load): `force` [N];
        `displacement` [m] of the inner ring and `stiffness` over `load` and `motion`, both averaged
        over the rollers' positions within a pitch; `variation` [1], the largest difference of an
        entry from this mean over the largest entry; and `held` [1], 0 where too few rollers are
        loaded to hold the ring. Coordinates name the `case` and the `kind` of the point.

    Raises
    ------
    InputError
        For another kind of bearing, or given loads of rollers.
    MacroslipError
        If a balance does not converge.

    Notes
    -----
    The tangent of the static balance of the ring (`macroslip.ring.balance`): Hertz contacts in
    series at both raceways, exponent 1.5, stiff rings, rollers at rest. Films, friction, seats and
    housing are left out. A spherical roller bearing aligns itself: contact normals pass through its
    centre, so that rows and columns of tilts are zero there. At a point a distance away along the
    shaft they follow from those of displacements.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case
    >>> case = Case(loads=BearingLoads.constant([0.0, -400e3, 100e3], 2.1, 1.0))
    >>> matrix = ring_stiffness({"base": case}).stiffness.isel(point=0)
    >>> [round(float(matrix.sel(load=f"F_{axis}0", motion=f"d_{axis}0")) / 1e9, 2) for axis in "XYZ"]
    [6.01, 7.55, 0.53]
    """
    points = []
    for name, case in cases.items():
        points += _points(name, case)
    stacked = {}
    for key in points[0]:
        stacked[key] = np.array([point[key] for point in points])
    stacked["held"] = stacked["held"].astype(np.int8)
    return xr.Dataset(
        STIFFNESS.put({name: stacked[name] for name in STIFFNESS}),
        {
            "axis": ["X0", "Y0", "Z0"],
            "load": list(LOADS),
            "motion": list(MOTIONS),
            "units": (("load", "motion"), np.array(UNITS)),
            "case": ("point", stacked["case"]),
            "kind": ("point", stacked["kind"]),
            "loads": ("point", stacked["loads"]),
            "bearing": ("point", stacked["bearing"]),
        },
        {"source": f"macroslip {macroslip.__version__}"},
    )


def _points(name: str, case: Case) -> list[dict[str, Any]]:
    """Operating points of a case."""
    if not kind_of(case.bearing).aligns_itself:
        raise InputError(
            f"{case.bearing.name} is a {case.bearing.kind} roller bearing, whose stiffness is not "
            "computed",
            where=name,
            allowed="double-row spherical roller bearings",
        )
    if isinstance(case.loads, RollerLoads):
        raise InputError(
            "loads of the rollers are given, so that no balance of the ring is computed",
            where=name,
            allowed="loads at the hub or on the bearing",
        )
    force = case.bearing_loads.force
    radial = case.bearing_loads.radial_load
    chosen = {
        "mean load": force.mean(axis=0),
        "least radial load": force[int(radial.argmin())],
        "largest radial load": force[int(radial.argmax())],
    }
    ring = _ring(case.bearing, case.lubricant)
    about = {
        "case": name,
        "bearing": case.bearing.name,
        "loads": without_folders(case.loads.source),
    }
    return [
        {**about, "kind": kind, "force": load, **_about(ring, load, name)}
        for kind, load in chosen.items()
    ]


def _ring(bearing: Bearing, lubricant: Lubricant) -> RingGeometry:
    model = roller_model(bearing, lubricant, 1, tilt=0.0)
    return ring_geometry(bearing, model)


def _about(ring: RingGeometry, force: FloatArray, name: str) -> dict[str, Any]:
    """Displacement, stiffness, its variation over a pitch, and whether the ring is held."""
    pitch = 4.0 * math.pi / ring.cosine.size
    numbers = np.arange(_POSITIONS)
    angle = pitch / ring.orbit_ratio * numbers / _POSITIONS
    loads = np.tile(force, (_POSITIONS, 1))
    at_rest = np.zeros((_POSITIONS, 3))
    displacement, unbalanced = balance(ring, angle, loads, at_rest)
    tolerated = _UNBALANCED * np.linalg.norm(force) + 1e-6
    if not (unbalanced <= tolerated).all():
        raise MacroslipError(
            f"{name}: the balance of the ring did not converge under {force.round(1).tolist()} N."
        )
    tangents = tangent_stiffness(ring, angle, displacement)
    mean = tangents.mean(axis=0)
    stiffness = np.zeros((len(LOADS), len(MOTIONS)))
    # Tilts about the centre leave a self-aligning bearing's approaches as they are.
    stiffness[:3, :3] = 0.5 * (mean + mean.T)  # exactly symmetric, in spite of rounding
    eigenvalues = np.linalg.eigvalsh(tangents)
    softest = eigenvalues[:, 0]
    stiffest = eigenvalues[:, -1]
    held = bool((softest > _HELD * stiffest).all())
    largest = np.abs(mean).max()
    variation = math.nan
    if largest > 0.0:
        largest_change = np.abs(tangents - mean).max()
        variation = float(largest_change / largest)
    return {
        "displacement": displacement.mean(axis=0),
        "stiffness": stiffness,
        "variation": variation,
        "held": held,
    }


def stiffness_table(stiffness: xr.Dataset) -> pd.DataFrame:
    """A line a point, with units in the headings.

    Parameters
    ----------
    stiffness : xarray.Dataset
        From `ring_stiffness`.

    Returns
    -------
    pandas.DataFrame
        Case, point, loads, bearing; load and displacement; the 25 entries by load and motion;
        variation and held.
    """
    columns: dict[str, Any] = {
        "case": stiffness.case.values,
        "point": stiffness.kind.values,
        "loads": stiffness.loads.values,
        "bearing": stiffness.bearing.values,
    }
    for axis in stiffness.axis.values.tolist():
        columns[f"F_{axis} [N]"] = stiffness.force.sel(axis=axis).values
    for axis in stiffness.axis.values.tolist():
        columns[f"d_{axis} [m]"] = stiffness.displacement.sel(axis=axis).values
    for load, line in zip(LOADS, UNITS, strict=True):
        for motion, unit in zip(MOTIONS, line, strict=True):
            entry = stiffness.stiffness.sel(load=load, motion=motion)
            columns[f"k {load} {motion} [{unit}]"] = entry.values
    columns["variation over a pitch [1]"] = stiffness.variation.values
    columns["held [1]"] = stiffness.held.values
    return pd.DataFrame(columns)


def stiffness_data(stiffness: xr.Dataset) -> dict[str, Any]:
    """Stiffness of the ring as plain data for JSON, with the matrices as lists of rows."""
    points = []
    for number in range(stiffness.sizes["point"]):
        point = stiffness.isel(point=number)
        points.append(
            {
                "case": point.case.item(),
                "point": point.kind.item(),
                "loads": point.loads.item(),
                "bearing": point.bearing.item(),
                "force [N]": point.force.values.tolist(),
                "displacement [m]": point.displacement.values.tolist(),
                "stiffness": point.stiffness.values.tolist(),
                "variation over a pitch [1]": float(point.variation),
                "held": bool(point.held),
            }
        )
    return {
        "computed by": stiffness.attrs["source"],
        "frame": "bearing frame at the bearing's centre: Z0 along the shaft, downwind; Y0 up, in "
        "the plane of the tilt; X0 = Y0 x Z0",
        "rows": list(LOADS),
        "columns": list(MOTIONS),
        "units": [list(line) for line in UNITS],
        "points": points,
    }
