"""The synthetic year of ten-minute means that comes with the program.

python -m tools.scada_example     # writes examples/scada.csv.gz anew
"""

from __future__ import annotations

from pathlib import Path

from macroslip.scada.synthetic import (
    SyntheticYear,
    base_turbine_friction,
    synthetic_year,
    write_record,
)

RECORD = Path("examples/scada.csv.gz")
#: Every row of 2023 is there; the heat balance of the bearing is the synthetic year's own.
EXAMPLE = SyntheticYear(noise=0.1, missing=0.0, start="2023-01-01", seed=45)

if __name__ == "__main__":
    write_record(synthetic_year(EXAMPLE, base_turbine_friction()), RECORD)
    print(f"{RECORD}: {RECORD.stat().st_size} bytes")
