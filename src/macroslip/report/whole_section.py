"""A bearing whose rollers and cages move together: balances, cage slip, pockets, and a comparison with imposed orbits."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report import whole_figures as draw
from macroslip.report.page import Block, Paragraph, Pictures, Table
from macroslip.report.pictures import picture

if TYPE_CHECKING:
    import xarray as xr

#: Keys of a case in which a result on imposed orbits may differ from the coupled one it is compared with.
_OWN_KEYS = ("dynamics", "cage", "traces", "rollers")


def is_whole(result: xr.Dataset) -> bool:
    """Whether orbit and spin were computed together."""
    return result.attrs.get("dynamics") == "whole-bearing" and "momentum_residual" in result


def counterpart(result: xr.Dataset, results: Mapping[str, xr.Dataset]) -> tuple[str, xr.Dataset] | None:
    """The result on imposed orbits of the same case, with its name."""
    wanted = _input(result)
    for name, one in results.items():
        if one is not result and "input" in one.attrs and not is_whole(one) and _input(one) == wanted:
            return name, one
    return None


def _input(result: xr.Dataset) -> dict[str, object]:
    return {key: value for key, value in json.loads(result.attrs["input"]).items() if key not in _OWN_KEYS}


def whole_blocks(result: xr.Dataset, results: Mapping[str, xr.Dataset]) -> tuple[Block, ...]:
    """Blocks on the coupled motion; none for a result on imposed orbits.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.
    results : mapping
        All results of the page by name; one on imposed orbits of the same case is compared.
    """
    if not is_whole(result):
        return ()
    blocks: list[Block] = [Paragraph(_slip_text(result), strong=True), Paragraph(_books_text(result))]
    found = counterpart(result, results)
    if found:
        blocks.append(_comparison(result, *found))
    blocks += [_pockets(result), _pictures(result)]
    return tuple(blocks)


def _slip_text(result: xr.Dataset) -> str:
    parts = [
        f"{'the cage' if name == 'both' else f'the cage of the {name} row'} turns {100 * abs(slip):.2g} % "
        f"{'faster' if slip >= 0.0 else 'slower'} than pure rolling (standard deviation {100 * deviation:.2g} %)"
        for name, slip, deviation in zip(
            result.cage.values.tolist(), result.cage_slip.values, result.cage_slip_deviation.values, strict=True
        )
    ]
    return f"Orbit and spin of all rollers were computed together with the cage: {'; '.join(parts)}."


def _books_text(result: xr.Dataset) -> str:
    impulses = max(
        float(abs(result[name]).max()) for name in result if str(name).endswith("_impulse") and "book" in str(name)
    )
    spent = sum(
        float(result[name].isel(book_time=-1)) for name in ("book_raceway_loss", "book_friction_loss", "pocket_loss")
    )
    momentum, energy = float(abs(result.momentum_residual).max()), float(abs(result.energy_residual).max())
    return (
        f"Angular momentum closes to {momentum:.1e} N m s of {impulses:.3g} N m s that passed through the bearing, and energy "
        f"to {energy:.1e} J of {spent:.3g} J dissipated: the first is what Newton's method leaves, the second the "
        "integrator's own error."
    )


def _comparison(result: xr.Dataset, name: str, imposed: xr.Dataset) -> Table:
    rows = []
    for row in result.row.values.tolist():
        for interface in result.interface.values.tolist():
            both = [float(one.energy.sel(row=row, interface=interface).mean("roller")) for one in (imposed, result)]
            ratio = both[1] / both[0] if both[0] > 0.0 else float("nan")
            rows.append(
                (row, interface, *(f"{value:.4g}" for value in both), f"{ratio:.4g}" if ratio == ratio else "–")
            )
    headings = ("row", "interface", "imposed orbit [J]", "whole bearing [J]", "ratio")
    caption = f"Energy of friction in the window, mean over the rollers, against {name}: the same case with the orbit imposed."
    return Table(headings, tuple(rows), caption)


def _pockets(result: xr.Dataset) -> Table:
    span = result.attrs["window_end"] - result.attrs["window_start"]
    rows = []
    for row in result.row.values.tolist():
        for side in result.side.values.tolist():
            one = result.sel(row=row, side=side)
            rows.append(
                (
                    row,
                    side,
                    f"{float(one.largest_pocket_force.max()):.4g}",
                    f"{float(one.pocket_impulse.mean()) / span:.4g}",
                    f"{100 * float(one.pocket_contact_time.mean()) / span:.3g}",
                )
            )
    headings = ("row", "spar", "largest force [N]", "mean force on a roller [N]", "time in contact [%]")
    return Table(headings, tuple(rows), "Forces of the spars in the window; front is the spar ahead along the orbit.")


def _pictures(result: xr.Dataset) -> Pictures:
    pictures = [
        picture(
            lambda axes, row=row: draw.plot_force_by_position(axes, result, row),
            f"Polar plot of the largest force of a spar on the {row} row by place on the orbit",
            width=3.9,
            height=4.4,
            polar=True,
        )
        for row in result.row.values.tolist()
    ]
    if result.sizes["book_time"] > 2:
        pictures.append(
            picture(
                lambda axes: draw.plot_residuals(axes, result),
                "Residuals of the balances of momentum and energy over time",
                legend="above",
            )
        )
    top = result.largest_force_by_position.sel(position=np.radians(90.0), method="nearest")
    over = ", ".join(f"{row} {float(top.sel(row=row)):.3g} N" for row in result.row.values.tolist())
    return Pictures(
        tuple(pictures),
        f"Largest force of a spar by place on the orbit, over all rollers, looking downwind; over the top: {over}. "
        "Single touches depend on rounding; where forces are large and small does not.",
    )
