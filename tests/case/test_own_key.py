"""A key of an input file is declared once: reader, messages, JSON Schema and Python follow."""

import json
import subprocess
import sys
from typing import Annotated

import pytest

from macroslip import InputError
from macroslip.input.fields import Positive
from macroslip.input.files import Location, parse
from macroslip.input.messages import together
from macroslip.input.section import input_section, json_schema, read_fields
from macroslip.input.units import FORCE, TIME


@input_section("brake", "brake of the shaft", positional=True)
class Brake:
    """Brake of the shaft, as a new section of a case would be declared."""

    force: Annotated[float, Positive("force of the brake", FORCE, 1e6)]
    delay: Annotated[float, Positive("time until it acts", TIME, 60.0)] = 0.5


def read(text: str) -> Brake:
    data, source = parse(text, "brake.yaml")
    values, problems = read_fields(Brake, data, Location(source))
    if problems:
        raise together(problems)
    return Brake(**values)


def test_a_file_has_the_key_with_its_unit_and_python_has_it_in_si():
    assert read("force: 12 kN") == Brake(12e3) == Brake(force=12e3, delay=0.5)
    assert read("force: 12 kN\ndelay: 200 ms").delay == 0.2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("delay: 1 s", r"'force' is missing \(force of the brake\)"),
        (
            "force: 12 kN\ndelay: 2 min\n",
            "line 2, delay: it is 2 min. Allowed: above 0, up to 1 min",
        ),
        ("force: 12", "line 1, force: it is 12, which does not give its unit.*N or kN"),
        ("force: 12 kN\ndelya: 1 s", "line 2: .*'delya'.*delay"),
    ],
)
def test_messages_name_line_value_range_and_key(text, message):
    with pytest.raises(InputError, match=message):
        read(text)


def test_a_call_in_python_is_checked_alike():
    with pytest.raises(InputError, match="delay.*61.*60 s"):
        Brake(12e3, delay=61.0)


def test_the_schema_has_key_unit_and_meaning():
    schema = json_schema(Brake)
    assert schema["required"] == ["force"]
    assert schema["properties"]["force"]["description"].startswith("force of the brake")
    assert "kN" in schema["properties"]["force"]["pattern"]


#: Declares a key of cases among the others, as if it stood in the file, and prints where it is known.
PROGRAM = """
import importlib.util
import json
import sys
from pathlib import Path

KEY = '''
    holding_force: Annotated[
        float, Quantity("force that holds the shaft", FORCE, 0.0, 1e6)
    ] = 0.0
'''
BEFORE = "    rating: Annotated["
name = "macroslip.case.case"
spec = importlib.util.find_spec(name)
text = Path(spec.origin).read_text(encoding="utf-8")
assert text.count(BEFORE) == 1
text = text.replace(BEFORE, KEY + BEFORE)
text = text.replace("import TEMPERATURE, ", "import FORCE, TEMPERATURE, ")
module = importlib.util.module_from_spec(spec)
sys.modules[name] = module
exec(compile(text, spec.origin, "exec"), vars(module))

from macroslip import Case, InputError, read_case
from macroslip.input.section import json_schema, keys_of

CASE = "loads: {main_bearing: {force: [0 kN, -400 kN, 0 kN], shaft_speed: 20 rpm, duration: 2 s}}\\n"
Path("case.yaml").write_text(CASE + "holding_force: 12 kN\\n")
read = read_case("case.yaml")
Path("wrong.yaml").write_text(CASE + "holding_force: 12 mm\\n")
try:
    read_case("wrong.yaml")
except InputError as problem:
    message = str(problem)
print(json.dumps({
    "read": read.holding_force,
    "stored": read.as_dict()["holding_force"],
    "default": Case(loads=read.loads).as_dict()["holding_force"],
    "about": json_schema(Case)["properties"]["holding_force"]["description"],
    "asked of the pages": "holding_force" in dict(keys_of(Case)),
    "message": message,
}))
"""


@pytest.mark.slow
def test_a_key_of_a_case_is_read_stored_and_described_from_its_declaration(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    known = json.loads(done.stdout)
    assert known["read"] == known["stored"] == 12e3
    assert known["default"] == 0.0
    assert known["about"].startswith("force that holds the shaft")
    assert known["asked of the pages"]
    assert "line 2, holding_force: it is '12 mm'" in known["message"]
