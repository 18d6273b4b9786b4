"""The description of the machine, also on systems that report less than Linux."""

import os
import re

from macroslip import machine as module


def test_systems_without_affinity_count_their_processors(monkeypatch):
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: 7)
    assert module.usable_processors() == 7
    assert module.machine()["cores"] == 7
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert module.usable_processors() == 1


def test_a_page_can_be_made_there(monkeypatch):
    import xarray as xr

    from macroslip.report.provenance import provenance_section

    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    section = provenance_section(
        {"one": xr.Dataset({"status": ("roller", [0])}, attrs={"source": "macroslip"})}
    )
    text = re.sub(r"<[^>]*>|\s+", " ", str(section.body))
    assert re.search(rf"this page: cores +{os.cpu_count()}\b", text)
