"""Make the estimated bearings of the catalogue: ``python -m tools.shipped_bearings``.

`catalogue/pages.csv` of `macroslip.bearing` holds what the maker publishes; every bearing in it gets a file, with `estimate_bearing` and its
default seed. `skf-240-600-bc` is not among them: its inside was worked out one by one.
"""

from __future__ import annotations

import csv
from pathlib import Path

import macroslip.bearing
from macroslip.bearing import Bearing
from macroslip.bearing.estimate import MakersPage, estimate_bearing

FOLDER = Path(macroslip.bearing.__file__).parent / "catalogue"
SOURCE = "SKF, Rolling bearings, catalogue 17000 EN (2018)"


def pages() -> dict[str, tuple[str, MakersPage]]:
    """Title and page of every bearing that is estimated, by its name.

    Examples
    --------
    >>> title, page = pages()["skf-240-630-bc"]
    >>> title, page.bore
    ('Double-row spherical roller bearing 240/630 BC, 630 x 920 x 290 mm', 0.63)
    """
    pages_by_name = {}
    lines = (FOLDER / "pages.csv").read_text(encoding="utf-8").splitlines()
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        designation, kind = row.pop("designation"), row.pop("variant")
        size = {key: float(value) for key, value in row.items()}
        title = f"Double-row spherical roller bearing {designation} {kind}, " + " x ".join(
            f"{size[key]:g}" for key in ("d_mm", "D_mm", "B_mm")
        )
        page = MakersPage(
            bore=1e-3 * size["d_mm"],
            outside=1e-3 * size["D_mm"],
            width=1e-3 * size["B_mm"],
            static_load_rating=1e3 * size["C0_kN"],
            axial_factor_e=size["e"],
            shoulder=1e-3 * size["D1_mm"],
            groove=1e-3 * size["groove_b_mm"],
            dynamic_load_rating=1e3 * size["C_kN"],
            fatigue_load_limit=1e3 * size["Pu_kN"],
            axial_factor_y1=size["Y1"],
            axial_factor_y2=size["Y2"],
            axial_factor_y0=size["Y0"],
            mass=size["mass_kg"],
        )
        pages_by_name[f"skf-{designation.replace('/', '-')}-{kind.lower()}"] = f"{title} mm", page
    return pages_by_name


def shipped_bearing(name: str) -> Bearing:
    """The bearing as its file has it.

    Examples
    --------
    >>> shipped_bearing("skf-240-630-bc") == Bearing.read("skf-240-630-bc")
    True
    """
    title, page = pages()[name]
    entries = estimate_bearing(page, name, title).bearing.as_dict()
    for entry in entries.values():
        if isinstance(entry, dict) and entry["tag"] == "V":
            entry["note"] = entry["note"].replace("maker's page", SOURCE)
    return Bearing.from_dict(entries)


def main() -> None:
    """Write the files."""
    for name in pages():
        text = shipped_bearing(name).as_yaml()
        (FOLDER / f"{name}.yaml").write_text(text, encoding="utf-8", newline="\n")
    print(f"{len(pages())} bearings in {FOLDER}")


if __name__ == "__main__":
    main()
