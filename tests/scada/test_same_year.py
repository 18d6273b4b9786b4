"""One record, written in several ways, has one year."""

import pytest

from macroslip.study.real_year import real_year
from tests.scada.conftest import record
from tests.study.made_up_study import made_up_study


def test_rows_shuffled_units_and_zone_give_the_same_year(read):
    table = record(rows=5000)
    table["bearing"] = table["bearing"].clip(10.0, 44.0)
    mixed = table.sample(frac=1.0, random_state=2)
    other = table.assign(
        time=table["time"].dt.tz_convert("Etc/GMT-5"),
        **{name: 1.8 * table[name] + 32.0 for name in ("bearing", "nacelle", "ambient")},
    )
    study = made_up_study(weights={"width": 4.0, "wind": {"weibull": "IEC II"}})
    first = real_year(read(table), study)
    # A degree Fahrenheit written with 15 digits is off by 1e-13 K.
    for scada, tolerance in ((read(mixed), 1e-15), (read(other, unit="degF"), 1e-12)):
        again = real_year(scada, study)
        for column in ("real", "at_mean", "oil_warmer"):
            assert again.table[column].to_numpy() == pytest.approx(
                first.table[column].to_numpy(), rel=tolerance, nan_ok=True
            )
