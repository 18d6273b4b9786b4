"""The keys of a case file, with what may stand under each: the one description that reader and schema share."""

from __future__ import annotations

from macroslip.case.form import Choice, Numbers, Plain, Quantity, Vector
from macroslip.case.section import Section, Variants
from macroslip.catalogue.units import ANGLE, FORCE, LENGTH, MASS, MOMENT, SPEED, TIME
from macroslip.constants import MECHANISMS
from macroslip.loads import bundled_cases
from macroslip.mechanisms import MODELS, asperity_laws, rheologies, viscosities

LOAD_SOURCES = ("bundled", "file", "bearing_file", "hub", "main_bearing")


_OWN_LAW = "A law of your own needs its file: macroslip run CASE --laws FILE."


def _film_laws() -> list[str]:
    from macroslip.film import film_law as law

    return law.names()


def _traction_laws() -> list[str]:
    from macroslip.traction import traction_law as law

    return [MECHANISMS, *law.names()]


_constant = {
    "force": Vector("three components of the force", Quantity("one component", FORCE)),
    "shaft_speed": Quantity("shaft speed", SPEED),
    "duration": Quantity("time for which the loads act", TIME),
}
_hub = _constant | {"moment": Vector("three components of the moment", Quantity("one component", MOMENT))}
_step = Quantity("fixed time step", TIME)

CASE = Section(
    "case",
    {
        "bearing": Plain("bearing: a name of the catalogue, or the path of a bearing file", str),
        "lubricant": Plain("lubricant: a name of the catalogue, or the path of a lubricant file", str),
        "loads": Section(
            "loads, from exactly one source",
            {
                "bundled": Choice("load case that comes with the package", bundled_cases),
                "file": Plain("hub loads: OpenFAST output (.outb, .out) or a table (.parquet, .csv)", str),
                "bearing_file": Plain("main-bearing loads: a table (.parquet, .csv)", str),
                "hub": Section("constant hub loads", _hub, required=tuple(_hub)),
                "main_bearing": Section("constant main-bearing load", _constant, required=tuple(_constant)),
                "start": Quantity("first time to read", TIME),
                "end": Quantity("last time to read", TIME),
            },
            one_of=LOAD_SOURCES,
        ),
        "drivetrain": Section(
            "supports and mass of the shaft",
            {
                "hub_to_bearing": Quantity("distance from hub centre to main bearing", LENGTH),
                "bearing_to_gearbox": Quantity("distance from main bearing to gearbox support", LENGTH),
                "tilt": Quantity("shaft tilt, positive with the hub end up", ANGLE),
                "shaft_mass": Quantity("mass of the shaft without rotor", MASS),
                "shaft_mass_station": Quantity("distance of that mass behind the hub centre", LENGTH),
            },
        ),
        "forces": Section(
            "forces on the rollers that can be switched off",
            {"gravity": Plain("weight of the rollers", bool), "drag": Plain("drag of the lubricant", bool)},
        ),
        "laws": Section(
            "physics in the contacts: a named set, and mechanisms that differ from it",
            {
                "model": Choice("named set of mechanisms", lambda: list(MODELS)),
                "film": Choice("film thickness", _film_laws, _OWN_LAW),
                "starvation": Plain("film thinned by the lubricant's starvation factor", bool),
                "inlet_heating": Plain("film thinned by shear heating in the inlet", bool),
                "viscosity": Choice("how viscosity rises with pressure", viscosities),
                "rheology": Choice("how the film's stress falls behind the Newtonian one", rheologies),
                "heating": Plain("shear heating of the film", bool),
                "microslip": Plain("slip that varies along the roller", bool),
                "asperities": Choice("share of the load that asperities carry", asperity_laws),
                "traction": Choice(
                    "mechanisms, or a traction law of your own in their place", _traction_laws, _OWN_LAW
                ),
            },
        ),
        "integrator": Variants(
            "method of integration in time",
            key="method",
            default="radau",
            sections={
                "radau": Section(
                    "error-controlled, implicit, in the slip",
                    {
                        "method": Plain("name of the method", str),
                        "tolerance": Plain("relative tolerance per step", float),
                        "max_steps": Plain("steps after which a roller counts as failed", int),
                    },
                ),
                "backward-euler": Section(
                    "fixed step, implicit, on the spin",
                    {
                        "method": Plain("name of the method", str),
                        "step": _step,
                        "tolerance": Plain("relative change of spin at which the iteration stops", float),
                    },
                    required=("step",),
                ),
                "explicit-euler": Section(
                    "fixed step, explicit, on the spin",
                    {"method": Plain("name of the method", str), "step": _step},
                    required=("step",),
                ),
            },
        ),
        "window": Section(
            "part of the time over which energies and peaks are taken",
            {
                "start": Quantity("start; auto: when the rollers have completed one orbit", TIME, words=("auto",)),
                "end": Quantity("end; without it, the end of the loads", TIME),
            },
        ),
        "rollers": Numbers("numbers of the rollers to simulate in each row, from 0", "all"),
        "traces": Section(
            "series to keep for every simulated roller",
            {
                "step": Quantity("time between samples", TIME),
                "start": Quantity("first time", TIME),
                "end": Quantity("last time", TIME),
            },
            required=("step",),
            word="none",
        ),
    },
    required=("loads",),
)
