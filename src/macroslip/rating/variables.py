"""The table of all variables of a rating: dimensions, units and meaning."""

from __future__ import annotations

from macroslip.variables import Variable, VariableTable

#: When a result has the variables of a rating.
RATED = "unless `rating: false`, of a bearing whose load ratings are known"

_RACEWAYS = ("row", "raceway")
_ALONG = ("load_along_roller",)
_SPECTRUM = ("load", "load_class")

RATING = VariableTable(
    "Rating of a bearing, `rate_case`; part of results",
    (
        Variable("static_equivalent_load", (), "N", RATED, "largest static equivalent load P0"),
        Variable("static_safety", (), "1", RATED, "static safety factor C0/P0, the least"),
        Variable("minimum_load", (), "N", RATED, "least load P that makers require"),
        Variable(
            "share_below_minimum_load",
            (),
            "1",
            RATED,
            "share of time in which P is below the maker's minimum load",
        ),
        Variable("equivalent_load", (), "N", RATED, "mean dynamic equivalent load P_m"),
        Variable("fatigue_load_limit", (), "N", RATED, "fatigue load limit C_u"),
        Variable(
            "share_below_fatigue_load_limit",
            (),
            "1",
            RATED,
            "share of time in which P is below the fatigue load limit C_u",
        ),
        Variable("viscosity_ratio", (), "1", RATED, "viscosity ratio kappa at the mean speed"),
        Variable("basic_life", (), "h", RATED, "basic rating life L10h, ISO 281"),
        Variable("life_modification", (), "1", RATED, "life modification factor a_ISO"),
        Variable("modified_life", (), "h", RATED, "modified rating life, ISO 281"),
        Variable("reference_life", _ALONG, "h", RATED, "basic reference rating life, ISO/TS 16281"),
        Variable(
            "raceway_reference_life",
            (*_ALONG, *_RACEWAYS),
            "h",
            RATED,
            "basic reference rating life, ISO/TS 16281, one raceway",
        ),
        Variable(
            "modified_reference_life",
            _ALONG,
            "h",
            RATED,
            "modified reference rating life, ISO/TS 16281",
        ),
        Variable(
            "loaded_share",
            ("row",),
            "1",
            RATED,
            "share of time in which a roller carries load, mean of the row",
        ),
        Variable("largest_roller_load", ("row",), "N", RATED, "largest roller load"),
        Variable("largest_pressure", _RACEWAYS, "Pa", RATED, "largest Hertz pressure"),
        Variable(
            "film_ratio", _RACEWAYS, "1", RATED, "film ratio Lambda, median over loaded rollers"
        ),
        Variable(
            "film_ratio_low",
            _RACEWAYS,
            "1",
            RATED,
            "film ratio Lambda, 5 % of loaded rollers below",
        ),
        Variable("time_share", _SPECTRUM, "1", RATED, "share of time in the class of load"),
        Variable(
            "revolution_share", _SPECTRUM, "1", RATED, "share of revolutions in the class of load"
        ),
        Variable(
            "damage_equivalent_load",
            ("load", "wohler_exponent"),
            "N",
            RATED,
            "range of the damage-equivalent load at 1 Hz",
        ),
        Variable("load_class_middle", ("load_class",), "N", RATED, "middle of the class of load"),
    ),
)
