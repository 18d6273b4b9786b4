"""A lubricant, and how it fills the bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Self

from macroslip.errors import InputError
from macroslip.input.fields import Positive, Quantity, Text
from macroslip.input.files import Source
from macroslip.input.messages import shown
from macroslip.input.record import Provenance, Record, dimensions, fields_of
from macroslip.input.units import (
    CONDUCTIVITY,
    DENSITY,
    INVERSE_PRESSURE,
    INVERSE_TEMPERATURE,
    KINEMATIC_VISCOSITY,
    LENGTH,
    NUMBER,
    PRESSURE,
    TEMPERATURE,
    VISCOSITY,
    is_finite_number,
    parse_quantity,
)
from macroslip.lubricant.base_oil import BASE_OILS
from macroslip.lubricant.inlet import Inlet, derive, moved_inlet, scaled_range

#: Inlet temperatures [K] over which `Lubricant.at` uses Walther's line: -20 to 150 degC.
COLDEST = 253.15
HOTTEST = 423.15
_Optional = float | None
#: Keys that a file may give instead of a value at the inlet.
_SOURCES: Mapping[str, tuple[str, ...]] = {
    "density": ("density_15",),
    "viscosity": ("kinematic_viscosity_40", "kinematic_viscosity_100"),
    "temperature_viscosity": ("kinematic_viscosity_40", "kinematic_viscosity_100"),
    "pressure_viscosity": (
        "roelands_index",
        "reference_pressure_viscosity",
        "reference_temperature",
    ),
}


class Lubricant(Record):
    """Data of a lubricant at the inlet of the contacts, and of its drag on the rollers.

    A file gives viscosity, temperature_viscosity, pressure_viscosity and density at the inlet
    temperature, or in place of each what data sheets give: kinematic_viscosity_40 and
    kinematic_viscosity_100, density_15, and roelands_index or reference_pressure_viscosity at a
    reference_temperature. The values at the inlet then follow. `at` gives the lubricant at another
    temperature.

    Attributes are in SI units (K, Pa s, m2/s, 1/Pa, 1/K, W/(m K), kg/m3); `provenance` gives the
    source of each. Raises InputError if a value is missing, out of range, or given in two ways.

    Examples
    --------
    >>> lubricant = Lubricant.read("vg460-pao")
    >>> lubricant.inlet_temperature, lubricant.viscosity, lubricant.pressure_viscosity
    (308.15, 0.54, 2.1e-08)
    """

    noun: ClassVar[str] = "lubricant"
    sections: ClassVar[Mapping[str, str]] = {
        "grease": "a grease's own behaviour, beside that of its base oil"
    }
    #: Gap where the inlets of contacts begin to be full [m], as `supplied` gives it.
    oil_gap = math.inf
    sources: ClassVar[Mapping[str, tuple[str, ...]]] = _SOURCES

    name: Annotated[str, Text("short name of the lubricant, used in results", line=True)]
    title: Annotated[
        str, Text("one line that describes the lubricant", may_be_empty=True, line=True)
    ] = ""
    base_oil: Annotated[
        str, Text(f"family of the base oil: {', '.join(BASE_OILS)}", may_be_empty=True, line=True)
    ] = ""
    thickener: Annotated[
        str,
        Text(
            "thickener of a grease; only the base oil enters the contacts here",
            may_be_empty=True,
            line=True,
        ),
    ] = ""

    inlet_temperature: Annotated[
        float, Quantity("temperature at the inlet of the contacts", TEMPERATURE, 200, 500)
    ]
    kinematic_viscosity_40: Annotated[
        _Optional, Quantity("kinematic viscosity at 40 degC", KINEMATIC_VISCOSITY, 2e-6, 0.1)
    ] = None
    kinematic_viscosity_100: Annotated[
        _Optional, Quantity("kinematic viscosity at 100 degC", KINEMATIC_VISCOSITY, 1e-6, 0.1)
    ] = None
    viscosity: Annotated[
        float, Positive("dynamic viscosity at inlet temperature, ambient pressure", VISCOSITY, 1000)
    ]
    roelands_index: Annotated[
        _Optional, Positive("Roelands' pressure-viscosity index Z", NUMBER, 2)
    ] = None
    reference_pressure_viscosity: Annotated[
        _Optional,
        Positive(
            "pressure-viscosity coefficient at the reference temperature", INVERSE_PRESSURE, 1e-7
        ),
    ] = None
    reference_temperature: Annotated[
        _Optional,
        Quantity(
            "temperature of the reference pressure-viscosity coefficient", TEMPERATURE, 200, 500
        ),
    ] = None
    pressure_viscosity: Annotated[
        float,
        Positive("pressure-viscosity coefficient at inlet temperature", INVERSE_PRESSURE, 1e-7),
    ]
    temperature_viscosity: Annotated[
        float,
        Positive(
            "temperature-viscosity coefficient beta in exp(-beta * temperature rise)",
            INVERSE_TEMPERATURE,
            1,
        ),
    ]
    thermal_conductivity: Annotated[float, Positive("thermal conductivity", CONDUCTIVITY, 10)]
    density_15: Annotated[_Optional, Quantity("density at 15 degC", DENSITY, 100, 5000)] = None
    density: Annotated[float, Quantity("density at inlet temperature", DENSITY, 100, 5000)]
    fill_factor: Annotated[
        float,
        Quantity("share of the space between the rollers that is filled, for drag", NUMBER, 0, 1),
    ]
    drag_coefficient: Annotated[
        float, Quantity("drag coefficient of a roller moving through the lubricant", NUMBER, 0, 100)
    ]

    limiting_shear: Annotated[
        _Optional, Positive("limiting shear stress / pressure of the film", NUMBER, 0.5)
    ] = None
    eyring_stress: Annotated[
        _Optional,
        Quantity(
            "Eyring stress at inlet temperature, at which shear thinning sets in",
            PRESSURE,
            1e4,
            1e9,
        ),
    ] = None
    boundary_friction: Annotated[
        _Optional, Quantity("friction coefficient where asperities carry the load", NUMBER, 0, 1)
    ] = None
    grease_yield_stress: Annotated[
        _Optional,
        Quantity("yield stress, which acts on idle rollers and in pockets", PRESSURE, 0, 1e5),
    ] = None

    def _fill(
        self,
        values: Mapping[str, Any],
        provenance: Mapping[str, Provenance],
        source: Source,
        derived: frozenset[str] = frozenset(),
    ) -> None:
        usable = {
            key: float(value)
            for key, value in values.items()
            if is_finite_number(value) and value > 0
        }
        try:
            following = derive(usable, provenance)
        except InputError as problem:
            where = source.file or problem.where
            raise problem.but(where=where) from None
        follows = {key: origin.value for key, origin in following.items()}
        super()._fill(
            {**values, **follows}, {**provenance, **following}, source, frozenset(following)
        )

    def _inconsistencies(self, source: Source) -> Iterator[InputError]:
        for key in _SOURCES.keys() - self._derived:
            twice = [other for other in _SOURCES[key] if getattr(self, other) is not None]
            if twice:
                yield InputError(
                    f"{key} and {' and '.join(twice)} are given",
                    where=source.where(key),
                    allowed="one or the other, since one follows from the other",
                    remedy="Leave out what is less certain.",
                )
        if self.roelands_index is not None and self.reference_pressure_viscosity is not None:
            yield InputError(
                "roelands_index and reference_pressure_viscosity are given",
                where=source.where("roelands_index"),
                allowed="one of the two",
                remedy="Leave out what is less certain.",
            )
        if self.base_oil and self.base_oil not in BASE_OILS:
            yield InputError(
                f"base_oil is {shown(self.base_oil)}",
                where=source.where("base_oil"),
                allowed=", ".join(BASE_OILS),
                remedy="Leave it out if it is none of these.",
            )

    def replace(self, **values: Any) -> Self:
        """Copy the lubricant with other values [SI], checked as any other input.

        They get the tag U.

        A value at the inlet, such as viscosity, takes the place of the figures from which it
        followed.
        """
        stated = self._stated() if self._derived & values.keys() else self
        return super(Lubricant, stated).replace(**values)

    def _stated(self, **changes: Provenance) -> Self:
        """The lubricant by its values at the inlet alone, some of them changed.

        Their origins are in SI.
        """
        sources = {source for those in _SOURCES.values() for source in those}
        kept = {key: origin for key, origin in self.provenance.items() if key not in sources}
        keys = [key for key in fields_of(type(self)) if key not in sources]
        values = {key: getattr(self, key) for key in keys}
        record = type(self).__new__(type(self))
        record._fill(
            values | {key: origin.value for key, origin in changes.items()},
            kept | changes,
            Source(),
        )
        return record

    def at(self, temperature: float | str) -> Self:
        """Give the lubricant at another inlet temperature.

        Viscosity and its temperature coefficient follow Walther's line (ASTM D341) through
        viscosity and slope at the present inlet temperature; density falls by 0.65 kg/(m3 K); the
        pressure-viscosity coefficient follows Roelands' law with constant index Z, alpha_p = Z (ln
        eta0 + 9.67)/p_r; the Eyring stress 2 gamma/alpha(T, p) rises as alpha falls. The limiting
        shear coefficient stays: measured changes with temperature are within 0.003.

        Parameters
        ----------
        temperature : float or str
            Inlet temperature [K], or text with its unit such as "50 degC"; -20 to 150 degC.

        Returns
        -------
        Lubricant
            Its changed values have the tag D. At its own temperature it is the lubricant itself.

        Raises
        ------
        InputError
            If the temperature is no number or out of range, or a law does not hold for the
            lubricant.

        Examples
        --------
        >>> warm = Lubricant.read("vg460-pao").at("50 degC")
        >>> tag = warm.provenance["viscosity"].tag
        >>> round(warm.viscosity, 4), round(warm.pressure_viscosity * 1e9, 2), tag
        (0.2496, 19.21, 'D')
        """
        where = f"lubricant {self.name}"
        if isinstance(temperature, str):
            temperature = TEMPERATURE.to_si(
                *parse_quantity(temperature, TEMPERATURE, "the inlet temperature", where)
            )
        if not is_finite_number(temperature) or not COLDEST <= temperature <= HOTTEST:
            fault = f"the inlet temperature is {shown(temperature)} K"
            allowed = f"{COLDEST:g} K to {HOTTEST:g} K, -20 to 150 degC, where Walther's line holds"
            raise InputError(
                fault,
                where=where,
                allowed=allowed,
                remedy="Give kelvin, or text such as '50 degC'.",
            )
        temperature = float(temperature)
        if temperature == self.inlet_temperature:
            return self
        here = Inlet(
            self.inlet_temperature,
            self.density,
            self.viscosity,
            self.temperature_viscosity,
            self.pressure_viscosity,
        )
        try:
            there = moved_inlet(here, temperature)
        except InputError as problem:
            raise problem.but(where=where) from None
        before = f"at {self.inlet_temperature:g} K"
        notes = {
            "density": f"0.65 kg/(m3 K) from {self.density:g} {before}",
            "viscosity": f"Walther line from {self.viscosity:g} Pa s {before}",
            "temperature_viscosity": "slope of the Walther line",
            "pressure_viscosity": f"Roelands' index constant, from {self.pressure_viscosity:g} 1/Pa {before}",
        }
        values = there._asdict()
        if self.eyring_stress is not None:
            notes["eyring_stress"] = f"2 gamma/alpha, from {self.eyring_stress:g} Pa {before}"
            values["eyring_stress"] = (
                self.eyring_stress * self.pressure_viscosity / there.pressure_viscosity
            )
        kinds = dimensions(type(self))
        origins = self.provenance
        changes = {"inlet_temperature": Provenance(temperature, "K")} | {
            key: Provenance(
                values[key], kinds[key].si_unit, "D", note, scaled_range(origins[key], values[key])
            )
            for key, note in notes.items()
        }
        return self._stated(**changes)

    def supplied(self, oil_gap: float) -> Lubricant:
        """The lubricant with inlets of contacts that are full from a gap [m] on.

        From 1 m on they are flooded.
        """
        made = SuppliedLubricant.__new__(SuppliedLubricant)
        values = {
            key: getattr(self, key) for key in fields_of(Lubricant) if key not in self._derived
        }
        made._fill(values | {"oil_gap": oil_gap}, dict(self._provenance), Source())
        return made


class SuppliedLubricant(Lubricant):
    """A lubricant and the inlets that it fills, as `Lubricant.supplied` gives it."""

    oil_gap: Annotated[
        float, Quantity("gap where the inlets of contacts begin to be full", LENGTH, 1e-9, 1e3)
    ]
