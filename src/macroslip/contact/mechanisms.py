"""Mechanisms of friction and lubrication that a case uses inside its contacts, with two named sets.

`Laws.paper()` is the model of Hart et al.; `Laws.physical()` switches on all of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from importlib import import_module
from typing import Annotated, Any

from macroslip.constants import KELLSTROEM, MECHANISMS
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Flag, Positive
from macroslip.input.messages import unknown_name
from macroslip.input.section import input_section
from macroslip.input.units import NUMBER
from macroslip.lubricant import Lubricant

_OWN_LAW = "A law of your own needs its file: macroslip run CASE --laws FILE."


def _names(module: str, holder: str, *first: str) -> Callable[[], list[str]]:
    """Names of laws, looked up only when a file or a call gives one.

    Kernels need not be imported to read a case.
    """

    def names() -> list[str]:
        laws = getattr(import_module(f"macroslip.contact.{module}"), holder)
        return [*first, *(laws if isinstance(laws, dict) else laws.names())]

    return names


@input_section("laws", "physics in the contacts: a named set, and mechanisms that differ from it")
class Laws:
    """Choice of mechanisms in the contacts, by the names of a case file; by default the paper's model.

    Raises InputError for a choice that does not exist, or one that a law of one's own makes void.

    Parameters
    ----------
    film : str
        Name of a film law.
    starvation : bool
        Whether the film is thinner where inlets lack oil, as the case's `oil_supply` says.
    inlet_heating : bool
        Whether shear in the inlet warms the oil and thins the film.
    viscosity : "barus" or "roelands"
        How viscosity rises with pressure; both have the slope `pressure_viscosity` at ambient
        pressure.
    rheology : "newtonian", "limiting-shear" or "eyring"
        How the film's stress falls behind the Newtonian one: not at all, limited to
        `limiting_shear` times pressure, or by Eyring's law with `eyring_stress`.
    heating : bool
        Whether shear heats the film and lowers its viscosity (Crook).
    microslip : bool
        Whether slip varies along the roller, by the contact's curvature and by the contact angle.
    asperities : str
        Name of a law for the share of the load that asperities carry, with `boundary_friction`;
        "none" without them.
    rolling : "none", "inlet" or "whole-film"
        Rolling resistance of the contacts and the cage, with the films of rollers that have play:
        none, that of the inlets as published, or that of whole films; less where inlets lack oil,
        as the case's `oil_supply` says.
    skew : "none" or "quasi-static"
        Whether rollers are held straight, or turn about their contacts' normal until nothing drives
        them on or the cage holds them; with microslip.
    traction : str
        "mechanisms": built from the choices above. "kellstroem": friction of the raceways in
        proportion to the slide-roll ratio up to a limit and constant beyond, in place of the
        sheared film's, which stays at the cage. Otherwise the name of a registered traction law,
        which replaces viscosity, rheology, heating and microslip.
    traction_limit_inner, traction_limit_outer : float
        Kellström's limits: coefficients of friction of inner and outer raceway [-], 0 to 1.
    traction_saturation : float
        Kellström's slide-roll ratio at which they are reached [-], 0 to 2.

    Examples
    --------
    >>> Laws.physical().rheology, Laws.paper().rheology
    ('eyring', 'newtonian')
    >>> Laws.paper().but(rheology="limiting-shear", viscosity="roelands").name
    'paper, but rheology limiting-shear, viscosity roelands'
    """

    film: Annotated[str, Choice("film thickness", _names("registry", "FILM_LAWS"), _OWN_LAW)] = (
        "masjedi-khonsari"
    )
    starvation: Annotated[bool, Flag("film thinned where inlets lack oil (oil_supply)")] = False
    inlet_heating: Annotated[bool, Flag("film thinned by shear heating in the inlet")] = False
    viscosity: Annotated[
        str, Choice("how viscosity rises with pressure", lambda: VISCOSITY_LAWS)
    ] = "barus"
    rheology: Annotated[
        str,
        Choice(
            "how the film's stress falls behind the Newtonian one", _names("traction", "RHEOLOGIES")
        ),
    ] = "newtonian"
    heating: Annotated[bool, Flag("shear heating of the film")] = True
    microslip: Annotated[bool, Flag("slip that varies along the roller")] = False
    asperities: Annotated[
        str, Choice("share of the load that asperities carry", _names("asperities", "REFERENCES"))
    ] = "none"
    rolling: Annotated[
        str,
        Choice(
            "rolling resistance, and films of rollers with play", _names("rolling", "REFERENCES")
        ),
    ] = "none"
    skew: Annotated[
        str, Choice("whether rollers turn about the normals of their contacts", lambda: SKEWS)
    ] = "none"
    traction: Annotated[
        str,
        Choice(
            "mechanisms, or a traction law of your own in their place",
            _names("registry", "TRACTION_LAWS", MECHANISMS, KELLSTROEM),
            _OWN_LAW,
        ),
    ] = MECHANISMS
    traction_limit_inner: Annotated[
        float, Positive("Kellström's coefficient of friction of the inner raceway", NUMBER, 1)
    ] = 0.05
    traction_limit_outer: Annotated[
        float, Positive("Kellström's coefficient of friction of the outer raceway", NUMBER, 1)
    ] = 0.05
    traction_saturation: Annotated[
        float,
        Positive("Kellström's slide-roll ratio from which on friction is constant", NUMBER, 2),
    ] = 0.01

    def __post_init__(self) -> None:
        self._check_kellstroem()
        if self.skew != "none" and not self.microslip:
            raise InputError(
                "skew needs slip that varies over the contacts, and these laws have no microslip",
                where="laws.skew",
                allowed="none, or laws with microslip",
                remedy="Choose model: physical, or set microslip: true beside model: paper.",
            )
        if self.traction not in (MECHANISMS, KELLSTROEM):
            void = [name for name in _REPLACED if getattr(self, name) != _DEFAULTS[name]]
            if void:
                choices = [f"{name} ({_word(getattr(self, name))})" for name in void]
                defaults = [f"{name}: {str(_DEFAULTS[name]).lower()}" for name in void]
                chosen = " and ".join(choices)
                beside = ", ".join(defaults)
                raise InputError(
                    f"the traction law '{self.traction}' excludes {chosen}: a traction law of one's own replaces these "
                    "mechanisms",
                    where="laws.traction",
                    allowed=f"{MECHANISMS}, or a law of one's own without these",
                    remedy="With your law, set model: paper and name the mechanisms you want to add to it, or keep "
                    f"the model and set {beside}",
                )

    def _check_kellstroem(self) -> None:
        """Refuse Kellström's numbers beside another traction, which has no use for them."""
        if self.traction == KELLSTROEM:
            return
        numbers = [name for name in _KELLSTROEM_KEYS if getattr(self, name) != _DEFAULTS[name]]
        if numbers:
            raise InputError(
                f"{' and '.join(numbers)} {'is' if len(numbers) == 1 else 'are'} given, and the "
                f"traction is '{self.traction}', which has no such number",
                where=f"laws.{numbers[0]}",
                allowed=f"with laws: {{traction: {KELLSTROEM}}}",
                remedy=f"Set laws.traction: {KELLSTROEM}, or remove {' and '.join(numbers)}.",
            )

    @classmethod
    def paper(cls) -> Laws:
        """The model of the paper: a rough film of self-heated Newtonian Barus oil.

        Slip is the same all over a contact.
        """
        return cls()

    @classmethod
    def physical(cls) -> Laws:
        """All mechanisms.

        Film for every load, starved and heated in the inlet; Roelands; Eyring's law; microslip;
        asperities; rolling resistance of whole films.

        Eyring's law, and not limiting shear, because traction measured on PAO and mineral oils
        keeps rising with the shear rate and reaches no limit; that of polyglycols does, so for them
        `rheology` is to be "limiting-shear".

        Vengudusamy, Enekes and Spallek, Friction (2019), doi:10.1007/s40544-019-0267-5; Jacod,
        Venner and Lugt, J. Tribol. 123 (2001) 248, doi:10.1115/1.1308021.
        """
        return cls(**PRESETS["physical"])

    @classmethod
    def named(cls, name: str) -> Laws:
        """The set called `name`, paper or physical; InputError for any other name."""
        if name not in PRESETS:
            raise unknown_name(name, list(PRESETS)).but(where="laws.model")
        return cls(**PRESETS[name])

    def but(self, **changes: Any) -> Laws:
        """A copy with some choices changed."""
        return replace(self, **changes)

    @property
    def name(self) -> str:
        """The set's name, or the one it is nearest to with what differs."""
        differences = {}
        for model in PRESETS:
            other = Laws.named(model)
            names = [
                member.name
                for member in fields(self)
                if getattr(self, member.name) != getattr(other, member.name)
            ]
            differences[model] = sorted(f"{name} {_word(getattr(self, name))}" for name in names)
        nearest = min(differences, key=lambda model: len(differences[model]))
        return nearest + (
            f", but {', '.join(differences[nearest])}" if differences[nearest] else ""
        )

    @property
    def asks_for_oil(self) -> bool:
        """True if a mechanism needs the filling of inlets: starvation, rolling resistance."""
        return self.starvation or self.rolling != "none"

    @property
    def is_closed_form(self) -> bool:
        """True if traction is the paper's, with heating or without, which has a closed form."""
        ruling = "viscosity", "rheology", "microslip", "traction"
        return all(getattr(self, name) == _DEFAULTS[name] for name in ruling)


#: Mechanisms that a traction law of one's own replaces.
_REPLACED = ("viscosity", "rheology", "heating", "microslip")
#: Numbers of Kellström's friction.
_KELLSTROEM_KEYS = ("traction_limit_inner", "traction_limit_outer", "traction_saturation")
_DEFAULTS: dict[str, Any] = {member.name: member.default for member in fields(Laws)}
SKEWS = ("none", "quasi-static")
VISCOSITY_LAWS = ("barus", "roelands")
#: Choices of each named set that differ from the defaults.
PRESETS: dict[str, dict[str, Any]] = {
    "paper": {},
    "physical": {
        "film": "masjedi-khonsari-moes",
        "starvation": True,
        "inlet_heating": True,
        "viscosity": "roelands",
        "rheology": "eyring",
        "microslip": True,
        "asperities": "masjedi-khonsari",
        "rolling": "whole-film",
    },
}


def _word(value: Any) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    return f"{value:g}" if isinstance(value, float) else str(value)


def check_lubricant(laws: Laws, lubricant: Lubricant) -> None:
    """Refuse a lubricant that lacks a value the chosen mechanisms need.

    Raises InputError naming the values and the mechanisms.
    """
    needed = {
        "limiting_shear": "limiting shear" if laws.rheology == "limiting-shear" else "",
        "eyring_stress": "Eyring's rheology" if laws.rheology == "eyring" else "",
        "boundary_friction": "asperity friction" if laws.asperities != "none" else "",
    }
    keys = [
        key for key, mechanism in needed.items() if mechanism and getattr(lubricant, key) is None
    ]
    if keys:
        purposes = dict.fromkeys(needed[key] for key in keys)
        lubricant.require(*keys, purpose=" and ".join(purposes))
