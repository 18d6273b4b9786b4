"""The JSON Schema of the file format agrees with what the reader accepts."""

import json
import re
from importlib import resources

import pytest
from ruamel.yaml import YAML

from macroslip.bearing import Bearing
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant

SHIPPED = [(kind, name) for kind in (Bearing, Lubricant) for name in kind.catalogue()]


def valid(value, schema):
    """Check a value against the few words of JSON Schema that the schema uses, and against no others."""
    known = {"$schema", "title", "description", "default", "type", "properties", "required", "additionalProperties",
             "enum", "minLength", "anyOf", "pattern", "items", "minItems", "maxItems"}  # fmt: skip
    assert schema.keys() <= known, schema.keys() - known
    if "enum" in schema and not any(
        value == item and type(value) is type(item) for item in schema["enum"]
    ):
        return False
    if "anyOf" in schema and not any(valid(value, branch) for branch in schema["anyOf"]):
        return False
    number = isinstance(value, int | float) and not isinstance(value, bool)
    match schema.get("type"):
        case "object":
            return (
                isinstance(value, dict)
                and set(schema["required"]) <= value.keys()
                and (value.keys() <= schema["properties"].keys() or schema["additionalProperties"])
                and all(
                    valid(value[key], inner)
                    for key, inner in schema["properties"].items()
                    if key in value
                )
            )
        case "string":
            long_enough = isinstance(value, str) and len(value) >= schema.get("minLength", 0)
            return long_enough and re.search(schema.get("pattern", ""), value) is not None
        case "array":
            in_bounds = (
                isinstance(value, list) and schema["minItems"] <= len(value) <= schema["maxItems"]
            )
            return in_bounds and all(valid(item, schema["items"]) for item in value)
        case "number":
            return number
        case "integer":
            return number and float(value).is_integer()
        case None:
            return True


def shipped(kind, name):
    package = "macroslip.bearing" if kind is Bearing else "macroslip.lubricant"
    file = resources.files(package) / "catalogue" / f"{name}.yaml"
    return YAML(typ="safe", pure=True).load(file.read_text(encoding="utf-8"))


@pytest.mark.parametrize(("kind", "name"), SHIPPED)
def test_shipped_files_are_valid(kind, name):
    schema = json.loads(json.dumps(kind.json_schema()))
    assert valid(shipped(kind, name), schema)
    assert valid(kind.read(name).as_dict(), schema)


@pytest.mark.parametrize(("kind", "name"), SHIPPED)
def test_schema_and_reader_refuse_the_same(kind, name):
    schema, good = kind.json_schema(), shipped(kind, name)
    quantities = [key for key in good if isinstance(good[key], dict)]
    needed = schema["required"][-1]
    for key in quantities:
        for change in ({"unit": "furlong"}, {"unit": None}, {"value": "1"}, {"tag": "Q"}, {"note": 1}, {"extra": 1},
                       {"range": 1}, {"range": [1]}, {"range": [None, 1e9]}, {"range": [1, 2, 3]}):  # fmt: skip
            bad = good | {key: good[key] | change}
            assert not valid(bad, schema), (key, change)
            with pytest.raises(InputError):
                kind.from_dict(bad)
        for bad in ("70", "70 furlongs", "mm 70", "70,5 mm", [70, "mm"], None):
            if bad == "70" and good[key]["unit"] == "1":
                continue  # a pure number needs no unit
            assert not valid(good | {key: bad}, schema), (key, bad)
            with pytest.raises(InputError):
                kind.from_dict(good | {key: bad})
    for bad in (
        good | {"unknown": 1},
        good | {"name": ""},
        {k: v for k, v in good.items() if k != needed},
    ):
        assert not valid(bad, schema)
        with pytest.raises(InputError):
            kind.from_dict(bad)


def test_units_of_the_schema_are_the_units_of_the_reader():
    properties = Bearing.json_schema()["properties"]

    def entry(key):
        return properties[key]["anyOf"][0]["properties"]

    assert entry("contact_angle")["unit"]["enum"] == ["rad", "mrad", "deg"]
    assert entry("pitch_radius")["unit"]["enum"] == ["m", "mm", "um"]
    assert entry("rollers_per_row")["value"]["type"] == "integer"
    assert properties["pitch_radius"]["description"].endswith("above 0, up to 5 m")
    assert "bore_diameter" not in Bearing.json_schema()["required"]
