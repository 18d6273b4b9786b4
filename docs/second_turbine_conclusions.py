"""Conclusions drawn from one turbine as rules over measures of a seat, for second_turbine.py."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from macroslip.constants import YEAR

#: Mean wind speeds of the load cases [m/s], and those of the paper among them.
WINDS = np.arange(4, 25, 2)
PAPER = WINDS >= 12
INTERFACES = ("inner", "outer", "cage")
ROWS = ("downwind", "upwind")
AS_IT_IS = "as it is"
#: Mean of the wind over a year, IEC class II [m/s].
MEAN_WIND = 8.5


class Seat:
    """Measures of a seat by row, quantity, wind, model and variant; NaN where there is none."""

    def __init__(self, measures: pd.DataFrame):
        keys = ["row", "quantity", "wind", "model", "variant"]
        self._values = measures.set_index(keys)["value"].to_dict()

    def at(
        self, row: str, quantity: str, wind: int, model: str = "physical", variant: str = AS_IT_IS
    ) -> float:
        """One measure."""
        return float(self._values.get((row, quantity, wind, model, variant), np.nan))

    def over(self, row: str, quantity: str, model: str = "physical") -> NDArray:
        """A measure over the wind, of the seat as it is."""
        return np.array([self.at(row, quantity, int(wind), model) for wind in WINDS])

    def friction_at(
        self, row: str, wind: int, model: str = "physical", variant: str = AS_IT_IS
    ) -> float:
        """Friction power of a roller [W], rolling resistance apart."""
        return sum(
            self.at(row, f"energy {interface}", wind, model, variant) for interface in INTERFACES
        )

    def friction(self, row: str, model: str = "physical") -> NDArray:
        """Friction power of a roller over the wind [W]."""
        return np.array([self.friction_at(row, int(wind), model) for wind in WINDS])

    def both(self, wind: int, variant: str) -> float:
        """Friction power of a roller of each row together [W]."""
        return sum(self.friction_at(row, wind, "physical", variant) for row in ROWS)

    def cage_share(self, row: str, model: str = "physical") -> NDArray:
        """Share of the cage in the friction of a roller over the wind."""
        return self.over(row, "energy cage", model) / self.friction(row, model)

    def per_year(self, row: str, quantity: str) -> NDArray:
        """A rate per second as one per year."""
        return YEAR * self.over(row, quantity)

    def wear(self) -> NDArray:
        """Wear of the deepest place over the wind [m/year], of the row with more."""
        return np.fmax(*(self.per_year(row, "wear_rate") for row in ROWS))

    def entries(self) -> NDArray:
        """Entries beyond a slide-roll ratio of 0.05 over the wind [1/s], both rows."""
        return np.nansum([self.over(row, "entry_rate") for row in ROWS], axis=0)

    def energies(self) -> NDArray:
        """Friction power over the wind of a roller of each row together [W]."""
        return self.friction("downwind") + self.friction("upwind")

    def variant(self, name: str, quantity: Callable[[str], float]) -> float:
        """A number of a variant over that of the seat as it is."""
        return quantity(name) / quantity(AS_IT_IS)

    def summary(self) -> pd.DataFrame:
        """What the conclusions rest on, over the wind, downwind and upwind where rows differ."""

        def rows(quantity: Callable[[str], NDArray], digits: int = 2) -> list[str]:
            down, up = (quantity(row) for row in ROWS)
            pairs = zip(down, up, strict=True)
            return [", ".join(_number(float(value), digits) for value in pair) for pair in pairs]

        columns = {
            "radial load, thrust [kN]": [
                f"{radial / 1e3:.0f}, {thrust / 1e3:.0f}"
                for radial, thrust in zip(
                    self.over("both", "radial"), self.over("both", "thrust"), strict=True
                )
            ],
            "pressed [%]": rows(lambda row: 100.0 * self.over(row, "pressed")),
            "friction of a roller [W]": rows(self.friction),
            "cage [%]": rows(lambda row: 100.0 * self.cage_share(row)),
            "Λ < 3 [%]": rows(lambda row: 100.0 * self.over(row, "mixed below 3")),
            "entries [1/h]": rows(lambda row: 3600.0 * self.over(row, "entry_rate")),
            "wear [µm/year]": [_number(1e6 * float(depth)) for depth in self.wear()],
            "torque/SKF": [_number(float(ratio)) for ratio in _torque(self)],
        }
        return pd.DataFrame(columns, index=pd.Index(WINDS, name="wind [m/s]"))


def rayleigh_shares(mean: float = MEAN_WIND) -> NDArray:
    """Shares of a year of the wind bins around `WINDS`, 2 m/s wide.

    Examples
    --------
    >>> round(float(rayleigh_shares().sum()), 3)
    0.909
    """
    edges = np.append(WINDS - 1.0, WINDS[-1] + 1.0)
    above = np.exp(-0.25 * np.pi * (edges / mean) ** 2)
    return above[:-1] - above[1:]


def below_rated(rate: NDArray) -> float:
    """Share of a year's sum of a rate over the wind that falls at 4 to 10 m/s."""
    parts = np.nan_to_num(rate) * rayleigh_shares()
    return float(parts[WINDS < 11].sum() / parts.sum())


class Conclusion(NamedTuple):
    """A conclusion, its number of a seat, and the rule by which it holds."""

    page: str
    statement: str
    number: Callable[[Seat], str]
    holds: Callable[[Seat], bool]


def table_text(conclusions: tuple[Conclusion, ...], seats: Mapping[str, Seat]) -> str:
    """The table of the page in Markdown."""
    lines = [
        "| drawn in | conclusion | " + " | ".join(f"`{name}`" for name in seats) + " |",
        "|" + "---|" * (2 + len(seats)),
    ]
    for conclusion in conclusions:
        cells = [_cell(conclusion, seat) for seat in seats.values()]
        lines.append(f"| {conclusion.page} | {conclusion.statement} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def summary_text(seats: Mapping[str, Seat], winds: tuple[int, ...] = (4, 8, 12, 18, 24)) -> str:
    """Numbers over some winds of all seats as a table in Markdown."""
    tables = [(name, seat.summary().loc[list(winds)]) for name, seat in seats.items()]
    names = ["seat", "wind [m/s]", *tables[0][1].columns]
    lines = ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    for name, table in tables:
        for wind, *cells in table.itertuples(name=None):
            lines.append(f"| `{name}` | {wind} | " + " | ".join(cells) + " |")
    return "\n".join(lines).replace("nan", "–")


def _cell(conclusion: Conclusion, seat: Seat) -> str:
    number = conclusion.number(seat)
    if "nan" in number:
        return "cannot be asked"
    return f"**{'holds' if conclusion.holds(seat) else 'does not'}**: {number}"


def _range(values: NDArray, digits: int = 2) -> str:
    """Lowest and highest of some values."""
    known = values[np.isfinite(values)]
    if not known.size:
        return "nan"
    low, high = (_number(float(end), digits) for end in (known.min(), known.max()))
    return low if low == high else f"{low} to {high}"


def _number(value: float, digits: int = 2) -> str:
    """A number to some significant digits, without an exponent.

    Examples
    --------
    >>> _number(1234.5), _number(0.01234), _number(0.0)
    ('1200', '0.012', '0')
    """
    if not np.isfinite(value) or value == 0.0:
        return "nan" if not np.isfinite(value) else "0"
    places = digits - 1 - int(np.floor(np.log10(abs(value))))
    return f"{round(value, places):.{max(places, 0)}f}"


def _percent(values: NDArray) -> str:
    return f"{_range(100.0 * values)} %"


def _idle_row(seat: Seat) -> str:
    pressed = seat.over("upwind", "pressed")
    slow, fast = pressed[WINDS < 8], pressed[WINDS >= 8]
    return f"{_percent(slow)} of the time at 4 and 6 m/s, {_percent(fast)} from 8 m/s on"


def _spin(seat: Seat) -> str:
    low, mean, high = (seat.at("upwind", f"spin idle{q}", 14) for q in (" 0.05", "", " 0.95"))
    return f"{_number(100 * mean)} %, 5 to 95 %: {_number(100 * low)} to {_number(100 * high)} %"


def _films(seat: Seat) -> str:
    shares = [100.0 * seat.at("downwind", "mixed below 3", wind) for wind in (4, 6, 8, 14)]
    return ", ".join(_number(share) for share in shares) + " % at 4, 6, 8, 14 m/s"


def _torque(seat: Seat) -> NDArray:
    return seat.over("both", "torque") / seat.over("both", "skf")


def _entry(seat: Seat) -> str:
    slip = seat.over("both", "criterion entry_slide_roll_ratio")
    flash = seat.over("both", "criterion entry_flash_temperature")
    return f"{_range(slip)}; {_range(flash)} K"


def _peak_wind(values: NDArray, where: NDArray | None = None) -> int:
    chosen = np.where(True if where is None else where, values, -np.inf)
    return int(WINDS[int(np.nanargmax(chosen))])


def _paper_energies(seat: Seat) -> NDArray:
    return seat.friction("downwind", "paper") + seat.friction("upwind", "paper")


def _energy_trend(seat: Seat) -> str:
    energy = seat.energies()
    over = _number(energy[4] / energy[-1])
    return f"highest at {_peak_wind(energy, PAPER)} m/s; 12 over 24 m/s {over}"


def _row_ratio(seat: Seat, model: str = "physical") -> NDArray:
    return (seat.friction("downwind", model) / seat.friction("upwind", model))[PAPER]


def _peak_ratio(seat: Seat) -> NDArray:
    return seat.over("downwind", "peak mean") / seat.over("upwind", "peak mean")


def _peaks(seat: Seat) -> str:
    mean, spread = seat.over("downwind", "peak mean"), seat.over("downwind", "peak std")
    deviation = _range((spread / mean)[PAPER])
    return f"{_number(mean[-1] / mean[4])}; deviation {deviation} of the mean"


def _static(seat: Seat, variant: str, row: str, model: str = "physical") -> float:
    return seat.friction_at(row, 14, model) / seat.friction_at(row, 14, model, variant)


def _year(seat: Seat) -> tuple[float, float, float]:
    return below_rated(seat.energies()), below_rated(seat.wear()), below_rated(seat.entries())


def _entries_over_wind(seat: Seat) -> str:
    hourly = 3600.0 * seat.entries()
    low, high = int(WINDS[hourly.argmin()]), int(WINDS[hourly.argmax()])
    least, most = _number(hourly.min()), _number(hourly.max())
    return f"fewest at {low} m/s ({least}), most at {high} m/s ({most})"


def _largest_peak(seat: Seat) -> NDArray:
    return np.fmax(*(seat.over(row, "peak largest") for row in ROWS))


def _raceways(seat: Seat, variant: str) -> float:
    return sum(
        seat.at(row, f"energy {raceway}", 12, "physical", variant)
        for row in ROWS
        for raceway in ("inner", "outer")
    )


def _worn(seat: Seat, variant: str) -> float:
    return max(seat.at(row, "wear_rate", 12, "physical", variant) for row in ROWS)


def _entries_of(seat: Seat, variant: str) -> float:
    return float(np.nansum([seat.at(row, "entry_rate", 12, "physical", variant) for row in ROWS]))


def _over(seat: Seat, variant: str, quantity: Callable[[Seat, str], float]) -> float:
    return quantity(seat, variant) / quantity(seat, AS_IT_IS)


def _energy(seat: Seat, variant: str) -> float:
    return seat.both(12, variant)


def _supply(seat: Seat) -> str:
    energy = [_over(seat, f"supply {supply}", _energy) for supply in ("flooded", "0.5")]
    wear = [_over(seat, f"supply {supply}", _worn) for supply in ("flooded", "0.5")]
    return f"energy {', '.join(map(_number, energy))}; wear {', '.join(map(_number, wear))}"


def _temperature(seat: Seat) -> str:
    return ", ".join(_number(_over(seat, f"oil at {celsius} °C", _worn)) for celsius in (25, 50))


def _clearance(seat: Seat) -> str:
    energy = _over(seat, "half the clearance", _energy)
    entries = _over(seat, "half the clearance", _entries_of)
    return f"energy {_number(energy, 3)}, entries {_number(entries)}"


def _skew(seat: Seat) -> str:
    energy = _over(seat, "skew", _energy)
    return f"energy {_number(energy, 3)}, wear {_number(_over(seat, 'skew', _worn), 3)}"


def _oval(seat: Seat) -> list[float]:
    return [_over(seat, f"oval {sign}50 µm", _raceways) for sign in "+-"]


def _friction_energy(seat: Seat) -> tuple[float, float]:
    rate, year = (
        float(
            (
                seat.over("both", f"criterion friction_energy_{kind}")
                / seat.over("both", f"reference friction_energy_{kind}")
            ).max()
        )
        for kind in ("rate", "year")
    )
    return rate, year


def _worn_years(seat: Seat) -> float:
    """Years until the deepest place has worn by 10 µm, over the wind of a year."""
    return 1e-5 / float((np.nan_to_num(seat.wear()) * rayleigh_shares()).sum())


def _life_years(seat: Seat) -> float:
    return seat.at("both", "basic life", 12) / 8766.0


def _paper_trend(seat: Seat) -> str:
    energy = _paper_energies(seat)[PAPER]
    if np.isnan(energy).any():
        return "nan"
    spread = energy.max() / energy.min() - 1.0
    lowest = WINDS[PAPER][energy.argmin()]
    return f"lowest at {lowest} m/s; {_number(100 * spread)} % between highest and lowest"


def _is_flat_under_paper(seat: Seat) -> bool:
    energy = _paper_energies(seat)[PAPER]
    return bool(energy.argmin() == 0 and energy.max() < 1.1 * energy.min())


def _pressed(seat: Seat) -> NDArray:
    """Share of time in which a roller of the upwind row is pressed, from 8 m/s on."""
    return seat.over("upwind", "pressed")[WINDS >= 8]


def _has_full_films(seat: Seat) -> bool:
    return seat.at("downwind", "mixed below 3", 4) > 0.5 and (
        seat.at("downwind", "mixed below 3", 14) < 0.05
    )


def _torque_text(seat: Seat) -> str:
    torque = _torque(seat)
    return f"{_range(torque[PAPER])}; at 4 to 10 m/s {_range(torque[~PAPER])}"


def _slips_at_entry(seat: Seat) -> bool:
    slip = seat.over("both", "criterion entry_slide_roll_ratio")
    flash = seat.over("both", "criterion entry_flash_temperature")
    return bool((slip > 0.05).all() and (flash < 10.0).all())


def _cage(seat: Seat, row: str = "downwind") -> NDArray:
    return seat.cage_share(row)[PAPER]


def _cage_text(seat: Seat) -> str:
    return f"{_percent(_cage(seat))}; upwind {_percent(_cage(seat, 'upwind'))}"


def _is_highest_near_rated(seat: Seat) -> bool:
    energy = seat.energies()
    return _peak_wind(energy, PAPER) <= 14 and energy[4] > 1.3 * energy[-1]


def _peaks_have_no_trend(seat: Seat) -> bool:
    ratio = seat.at("downwind", "peak mean", 24) / seat.at("downwind", "peak mean", 12)
    return 2.0 / 3.0 < ratio < 1.5


def _peak_ratio_text(seat: Seat) -> str:
    ratio = _peak_ratio(seat)
    return f"{_number(ratio[4])} at 12 m/s, {_number(ratio[-1])} at 24 m/s"


def _static_text(seat: Seat) -> str:
    mean, radial = (
        _number(_static(seat, variant, "downwind")) for variant in ("mean load", "mean radial load")
    )
    return f"{mean}; without thrust {radial}"


def _year_text(seat: Seat) -> str:
    return ", ".join(f"{_number(100.0 * share)} %" for share in _year(seat))


def _wear_text(seat: Seat) -> str:
    wear = seat.wear()
    return f"most at {_peak_wind(wear)} m/s; 4 over 24 m/s {_number(wear[0] / wear[-1])}"


def _entries_follow_thrust(seat: Seat) -> bool:
    entries = seat.entries()
    return WINDS[entries.argmin()] in (10, 12) and WINDS[entries.argmax()] >= 22


def _largest_peak_text(seat: Seat) -> str:
    peaks = _largest_peak(seat)
    return f"{_number(float(peaks.max()))} W at {_peak_wind(peaks)} m/s"


def _supply_moves_friction(seat: Seat) -> bool:
    names = ("supply flooded", "supply 0.5")
    return all(
        _over(seat, name, _energy) > 1.0 and abs(_over(seat, name, _worn) - 1.0) < 0.1
        for name in names
    )


def _temperature_decides(seat: Seat) -> bool:
    return (
        _over(seat, "oil at 25 °C", _worn) < 1.0 / 3.0 and _over(seat, "oil at 50 °C", _worn) > 3.0
    )


def _friction_energy_text(seat: Seat) -> str:
    rate, year = _friction_energy(seat)
    return f"{_number(rate)} and {_number(year)} of it at most"


def _exceeds_test_in_a_year(seat: Seat) -> bool:
    rate, year = _friction_energy(seat)
    return rate < 0.1 and year > 1.0


def _mixed(seat: Seat) -> NDArray:
    return seat.over("both", "criterion mixed_time")


CONCLUSIONS = (
    Conclusion(
        "first page",
        "the upwind row is idle (its rollers pressed for less than 10 % of the time from 8 m/s on)",
        _idle_row,
        lambda seat: bool((_pressed(seat) < 0.1).all()),
    ),
    Conclusion(
        "first page",
        "rollers without load turn far below rolling speed (mean below 30 %, 14 m/s)",
        _spin,
        lambda seat: seat.at("upwind", "spin idle", 14) < 0.3,
    ),
    Conclusion(
        "first page",
        "loaded contacts run on a full film but for low wind (Λ < 3: most of the loaded time at "
        "4 m/s, less than 5 % at 14)",
        _films,
        _has_full_films,
    ),
    Conclusion(
        "first page",
        "torque is that of the SKF model (within 15 % from 12 m/s on)",
        _torque_text,
        lambda seat: bool((np.abs(_torque(seat)[PAPER] - 1.0) < 0.15).all()),
    ),
    Conclusion(
        "danger",
        "slip at entry is beyond 0.05 in every case, with a rise of some kelvins",
        _entry,
        _slips_at_entry,
    ),
    Conclusion(
        "findings",
        "the cage has a quarter to a third of the energy downwind (20 to 40 %, 12 to 24 m/s)",
        _cage_text,
        lambda seat: bool(((_cage(seat) > 0.2) & (_cage(seat) < 0.4)).all()),
    ),
    Conclusion(
        "findings",
        "energy is highest at 12 and 14 m/s (of 12 to 24), 1.3 times that at 24 m/s or more",
        _energy_trend,
        _is_highest_near_rated,
    ),
    Conclusion(
        "findings",
        "the downwind row spends about ten times the energy (5 or more, 12 to 24 m/s)",
        lambda seat: f"{_range(_row_ratio(seat))} times",
        lambda seat: bool((_row_ratio(seat) > 5.0).all()),
    ),
    Conclusion(
        "findings",
        "peak power has no trend downwind (24 over 12 m/s within 1.5)",
        _peaks,
        _peaks_have_no_trend,
    ),
    Conclusion(
        "findings",
        "the ratio of mean peaks, downwind to upwind, falls with wind (to half or less)",
        _peak_ratio_text,
        lambda seat: bool(_peak_ratio(seat)[4] > 2.0 * _peak_ratio(seat)[-1]),
    ),
    Conclusion(
        "findings",
        "time-varying loads have the energy of their mean (within 30 %, downwind, 14 m/s)",
        _static_text,
        lambda seat: abs(_static(seat, "mean load", "downwind") - 1.0) < 0.3,
    ),
    Conclusion(
        "findings, `paper`",
        "energy is lowest at 12 m/s, and flat (within 10 %)",
        _paper_trend,
        _is_flat_under_paper,
    ),
    Conclusion(
        "findings, `paper`",
        "both rows spend nearly the same (less than 1.5 times)",
        lambda seat: f"{_range(_row_ratio(seat, 'paper'))} times",
        lambda seat: bool((_row_ratio(seat, "paper") < 1.5).all()),
    ),
    Conclusion(
        "a-year",
        "most energy, wear and entries fall below rated (4 to 10 m/s)",
        _year_text,
        lambda seat: min(_year(seat)) > 0.5,
    ),
    Conclusion(
        "a-year",
        "wear by the hour is most at 4 or 6 m/s",
        _wear_text,
        lambda seat: _peak_wind(seat.wear()) <= 6,
    ),
    Conclusion(
        "a-year",
        "entries by the hour are fewest at 10 or 12 m/s, most at 22 or 24",
        _entries_over_wind,
        _entries_follow_thrust,
    ),
    Conclusion(
        "a-year",
        "the largest power of a roller is at 22 or 24 m/s",
        _largest_peak_text,
        lambda seat: _peak_wind(_largest_peak(seat)) >= 22,
    ),
    Conclusion(
        "a-year",
        "flooded, and at a supply of 0.5, energy rises and wear hardly changes (12 m/s)",
        _supply,
        _supply_moves_friction,
    ),
    Conclusion(
        "a-year",
        "temperature decides wear (25 and 50 °C over 35 °C: below a third, above 3; 12 m/s)",
        _temperature,
        _temperature_decides,
    ),
    Conclusion(
        "a-year",
        "clearance hardly moves energy (half of it, within 10 %; 12 m/s)",
        _clearance,
        lambda seat: abs(_over(seat, "half the clearance", _energy) - 1.0) < 0.1,
    ),
    Conclusion(
        "a-year",
        "skew adds an eighth of energy and hardly any wear (5 to 20 %, and below 5 %; 12 m/s)",
        _skew,
        lambda seat: (
            0.05 < _over(seat, "skew", _energy) - 1.0 < 0.2 and _over(seat, "skew", _worn) < 1.05
        ),
    ),
    Conclusion(
        "danger",
        "the shape of the housing comes first (±50 µm oval: raceway energy 1.2 times or more one "
        "way; 12 m/s)",
        lambda seat: ", ".join(_number(ratio, 3) for ratio in _oval(seat)),
        lambda seat: max(_oval(seat)) > 1.2,
    ),
    Conclusion(
        "danger",
        "e_a is far below the FE8 test's, its sum of a year above",
        _friction_energy_text,
        _exceeds_test_in_a_year,
    ),
    Conclusion(
        "danger",
        "Λ < 1 never occurs in production",
        lambda seat: _percent(_mixed(seat)),
        lambda seat: bool((_mixed(seat) == 0.0).all()),
    ),
    Conclusion(
        "danger",
        "wear of 10 µm takes more than a century at 35 °C",
        lambda seat: f"{_number(_worn_years(seat))} years",
        lambda seat: _worn_years(seat) > 100.0,
    ),
    Conclusion(
        "danger",
        "fatigue takes more than a century (basic rating life, 12 m/s)",
        lambda seat: f"{_number(_life_years(seat))} years",
        lambda seat: _life_years(seat) > 100.0,
    ),
)
