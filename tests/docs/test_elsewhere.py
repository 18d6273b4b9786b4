"""Recipes, workflows and the page on support agree with the package."""

import re
import tomllib
from pathlib import Path

import pytest
from ruamel.yaml import YAML

import macroslip

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PAGE = (ROOT / "docs" / "support.md").read_text(encoding="utf-8")


def test_the_conda_recipe_has_version_and_packages_of_the_project():
    recipe = (ROOT / "conda" / "meta.yaml").read_text(encoding="utf-8")
    assert f'{{% set version = "{macroslip.__version__}" %}}' in recipe
    run = recipe.partition("  run:\n")[2].partition("\n\n")[0]
    listed = [line.strip("- ").replace(" ", "") for line in run.splitlines()]
    python = f"python{PROJECT['requires-python']}"
    assert sorted(listed) == sorted([python, *PROJECT["dependencies"]])


def test_workflows_run_every_python_of_the_classifiers():
    workflow = YAML(typ="safe").load(
        (ROOT / ".github" / "workflows" / "tests.yml").read_text(encoding="utf-8")
    )
    matrix = workflow["jobs"]["tests"]["strategy"]["matrix"]
    classifiers = [
        re.fullmatch(r".*Python :: (3\.\d+)", classifier) for classifier in PROJECT["classifiers"]
    ]
    assert matrix["python"] == [classifier[1] for classifier in classifiers if classifier]
    assert matrix["system"] == ["ubuntu-latest", "macos-latest", "windows-latest"]


@pytest.mark.parametrize("path", sorted((ROOT / ".github" / "workflows").glob("*.yml")))
def test_actions_are_pinned_and_have_no_rights_by_default(path):
    text = path.read_text(encoding="utf-8")
    used = re.findall(r"uses: (\S+)", text)
    assert used and all(re.fullmatch(r"[\w.-]+/[\w.-]+@[0-9a-f]{40}", action) for action in used)
    assert YAML(typ="safe").load(text)["permissions"] == {}


def test_the_stable_names_are_those_of_the_package():
    names = PAGE.partition("* The names of the package:")[2].partition("\n\n")[0]
    listed = re.findall(r"`(\w+)`", names)
    assert listed == sorted(set(macroslip.__all__) - {"__version__"})
    assert all(getattr(macroslip, name) is not None for name in listed)


def test_the_page_installs_the_present_version():
    assert f"macroslip-{macroslip.__version__}.tar.gz" in PAGE


def test_the_image_runs_without_rights():
    lines = (ROOT / "Dockerfile").read_text(encoding="utf-8").splitlines()
    users = [line for line in lines if line.startswith("USER ")]
    assert users == ["USER 1000"]
    assert lines.index(users[0]) < lines.index('ENTRYPOINT ["macroslip"]')
