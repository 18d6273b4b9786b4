"""Make the bundled load cases from 50 Hz simulation records: ``python tools/bundled_loads.py SOURCE_DIR...``.

Each record becomes ``src/macroslip/loads/cases/<name>.parquet``: 20 Hz, float32, with its provenance in the schema metadata.

The filter. 50 Hz becomes 20 Hz by inserting a zero after every sample (100 Hz), a symmetric Kaiser-window FIR, and
keeping every fifth value. Symmetry means no delay: sample i of the result is at i/20 s, and every second one
coincides with a sample of the source. Measured on the 337 taps (± 1.68 s): the gain is within 1.0e-4 of 1 up to 8.5
Hz, half at 9.25 Hz, and below 1.0e-4 (−80 dB) from 10 Hz on. As 10 Hz is the new Nyquist frequency, nothing folds
back above that level; a default of about 53 dB with half gain at 10 Hz would fold the band above 10 Hz onto 8.4 to 10
Hz. Before the first and after the last sample the record is continued by its point reflection in that sample, which
keeps value and slope; within 1.68 s of either end the result therefore depends partly on that continuation.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import macroslip.loads
from macroslip.errors import InputError
from macroslip.loads.bundled import ASSUMED, TURBINES, BundledCase, bundled_case, bundled_names

SOURCE_RATE, RATE = 50, 20
PASS_BAND, STOP_BAND = 8.5, 10.0
COLUMNS = {
    "rotor_speed_rpm": "rpm",
    "fx_N": "N",
    "fy_N": "N",
    "fz_N": "N",
    "mx_Nm": "N m",
    "my_Nm": "N m",
    "mz_Nm": "N m",
    "wind_mps": "m/s",
}


def anti_alias_filter() -> NDArray[np.float64]:
    """Coefficients of the low-pass at 100 Hz, symmetric, unit sum.

    Examples
    --------
    >>> taps = anti_alias_filter()
    >>> taps.size, round(float(taps.sum()), 12)
    (337, 1.0)
    """
    from scipy.signal import firwin, kaiserord

    taps, beta = kaiserord(80.0, (STOP_BAND - PASS_BAND) / SOURCE_RATE)
    return np.asarray(
        firwin(taps | 1, 0.5 * (PASS_BAND + STOP_BAND), window=("kaiser", beta), fs=2 * SOURCE_RATE)
    )


def decimate(values: NDArray) -> NDArray[np.float64]:
    """Bring a record (n,) or (n, k), sampled at 50 Hz, to 20 Hz; sample 0 stays at its time."""
    from scipy.signal import resample_poly

    return resample_poly(
        np.asarray(values, dtype=np.float64),
        2,
        5,
        axis=0,
        window=anti_alias_filter(),
        padtype="antireflect",
    )


def write_case(
    case: str, columns: Mapping[str, NDArray], provenance: Mapping[str, str], target: Path
) -> None:
    """Decimate the 50 Hz `columns` of one case and write ``<case>.parquet`` into the folder `target`."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    values = {name: decimate(columns[name]).astype(np.float32) for name in COLUMNS}
    time = (np.arange(values["fx_N"].size) / RATE).astype(np.float32)
    metadata = {
        "case": case,
        "turbine": TURBINES[bundled_case(case).turbine],
        **provenance,
        "nature": "simulated hub loads, not measurements",
        "frame": "rotor on shaft at the hub centre; non-rotating shaft axes: x downwind along the shaft, z up, "
        "y = z cross x",
        "time": provenance.get("time", "0 s is simulation time 60 s"),
        "decimation": f"{SOURCE_RATE} Hz to {RATE} Hz, symmetric Kaiser FIR, gain 1 within 1e-4 up to {PASS_BAND} Hz "
        f"and below 1e-4 from {STOP_BAND:g} Hz, point-reflected ends",
        "units": json.dumps({"time_s": "s"} | COLUMNS),
        "made_by": "tools/bundled_loads.py",
    }
    table = pa.table({"time_s": time} | values).replace_schema_metadata(metadata)
    # Byte-stream split groups the exponents of neighbouring samples, which compress; their mantissas do not.
    pq.write_table(
        table,
        target / f"{case}.parquet",
        compression="zstd",
        compression_level=19,
        use_dictionary=False,
        use_byte_stream_split=True,
    )


def record_of(case: BundledCase) -> str:
    """File name of the source record of a case.

    Examples
    --------
    >>> [record_of(bundled_case(name)) for name in ("14B", "8B-2", "yaw20-14")]
    ['windpact1.5_14mps_B.parquet', 'windpact1.5_8mps_B_s2.parquet', 'windpact1.5_yaw20_14.parquet']
    >>> record_of(bundled_case("nrel5-8B-2"))
    'nrel5_8mps_B_s2.parquet'
    """
    if case.event:
        record = case.name.replace("yaw20-", "yaw20_").replace("-", "")
    else:
        second = "_s2" if case.seed == 2 else ""
        record = f"{case.wind_speed:g}mps_{case.turbulence}{second}"
    return f"{case.turbine}_{record}.parquet"


def convert(case: BundledCase, record: Path, target: Path) -> None:
    """Thin the 50 Hz record of a case and write it with its provenance into the folder `target`."""
    import pyarrow.parquet as pq

    table = pq.read_table(record)
    stored = {key.decode(): text.decode() for key, text in table.schema.metadata.items()}
    if stored["sample_rate_Hz"] != str(SOURCE_RATE):
        raise InputError(
            f"sampled at {stored['sample_rate_Hz']} Hz",
            where=str(record),
            allowed=f"{SOURCE_RATE} Hz",
        )
    provenance = {
        "source": stored["code"],
        "wind": stored["case"],
        "turbsim_seeds": stored["seeds"],
    }
    if case.event:
        provenance["time"] = "0 s is after the discarded start of the simulation"
        provenance["control"] = (
            f"{ASSUMED}: rates, speeds and delays are usual magnitudes, see README.md"
        )
    write_case(case.name, {name: table[name].to_numpy() for name in COLUMNS}, provenance, target)


def main(arguments: list[str] | None = None) -> None:
    """Convert every bundled case whose 50 Hz record is in a folder, and report the size."""
    parser = argparse.ArgumentParser(
        description="Make the bundled load cases from 50 Hz simulation records."
    )
    parser.add_argument(
        "sources", type=Path, nargs="+", help="folders of TURBINE_....parquet files"
    )
    folders = parser.parse_args(arguments).sources
    target = Path(macroslip.loads.__path__[0]) / "cases"
    records = {path.name: path for folder in folders for path in folder.glob("*.parquet")}
    known = [bundled_case(name) for name in bundled_names()]
    cases = [case for case in known if record_of(case) in records]
    if not cases:
        raise InputError(
            "no record of a bundled case is there",
            where=", ".join(map(str, folders)),
            allowed=f"{record_of(known[0])} and the like",
            remedy="Give the folders that hold the records.",
        )
    for case in cases:
        convert(case, records[record_of(case)], target)
    total = sum(path.stat().st_size for path in target.glob("*.parquet"))
    print(f"{len(cases)} cases made; {total / 1e6:.2f} MB in {target}")


if __name__ == "__main__":
    main()
