"""What pydantic finds wrong with a section, in the words of this package: one paragraph, with place and remedy."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any, get_origin

from pydantic import ValidationError
from pydantic.fields import FieldInfo

from macroslip.catalogue.forms import Choice
from macroslip.catalogue.problems import shown, unknown_key
from macroslip.catalogue.section_forms import ABOUT, fields_of, form_of, sections_of, variants_of, word_of
from macroslip.catalogue.source import Place
from macroslip.errors import InputError


def problems_of(failure: ValidationError, kind: Any, place: Place, noun: str = "") -> list[InputError]:
    """What pydantic found, in paragraphs: unknown keys first, then the others in the order of the fields."""
    details = failure.errors(include_url=False)
    details.sort(key=lambda detail: detail["type"] != "unexpected_keyword_argument")
    unknown = {
        (*detail["loc"][:-1], close)
        for detail in details
        if detail["type"] == "unexpected_keyword_argument"
        for close in get_close_matches(str(detail["loc"][-1]), _siblings(kind, detail["loc"]), n=1)
    }
    found = []
    for detail in details:
        if detail["type"] != "missing" or detail["loc"] not in unknown:  # a misspelled key is not missing as well
            found.append(_problem(detail, kind, place, noun))
    return found


def _siblings(kind: Any, loc: tuple[Any, ...]) -> list[str]:
    return _walk(kind, loc[:-1])[2]


def _walk(kind: Any, loc: tuple[Any, ...]) -> tuple[list[str], FieldInfo | None, list[str]]:
    """Keys as the file has them, the field at their end if it is one, and the keys that it may have inside."""
    field = kind if isinstance(kind, FieldInfo) else None
    sections = sections_of(field) if field else [kind]
    keys: list[str] = []
    names: list[str] = []
    for step in loc:
        if field and get_origin(field.annotation) is dict:
            keys.append(str(step))
            field = None
            continue
        variants = variants_of(field) if field else None
        if variants and step in variants.sections:
            sections, names = [variants.sections[step]], [variants.key]
            field = None
            continue
        inner = next((fields_of(section)[step] for section in sections if step in fields_of(section)), None)
        keys.append(str(step))
        field, names = inner, []
        sections = sections_of(inner) if inner else []
    return keys, field, [*names, *(key for section in sections for key in fields_of(section))]


def _problem(detail: Mapping[str, Any], kind: Any, place: Place, noun: str) -> InputError:
    """One problem that pydantic found, in one paragraph."""
    loc, problem = detail["loc"], detail.get("ctx", {}).get("error")
    keys, field, inside = _walk(kind, loc)
    here = place.inside(*keys)
    if isinstance(problem, InputError):
        if noun:
            return InputError(problem.what, where=noun, allowed=problem.allowed, remedy=problem.remedy)
        return here.blamed(problem)
    if detail["type"] in ("unexpected_keyword_argument", "extra_forbidden"):
        around = place.inside(*keys[:-1])
        return unknown_key(
            loc[-1], _siblings(kind, loc), where=noun or here.source.where(*here.keys), inside=around.key
        )
    if detail["type"] in ("missing", "missing_keyword_only_argument"):
        key = str(loc[-1])
        section_place = place.inside(*keys[:-1]) if keys and keys[-1] == key else here
        return missing_key(key, field, section_place, noun)
    variants = variants_of(field) if detail["type"].startswith("union_tag") and field is not None else None
    if variants is not None:
        name = detail["input"].get(variants.key) if isinstance(detail["input"], Mapping) else detail["input"]
        try:
            Choice(variants.about, lambda: list(variants.sections)).read(name, None)
        except InputError as wrong:
            return here.inside(variants.key).blamed(wrong)
    allowed = _form_text(field, inside)
    what = f"{'it' if not noun or not loc else loc[-1]} is {shown(detail['input'])}"
    return InputError(what, where=noun, allowed=allowed) if noun else here.problem(what, allowed)


def _form_text(field: FieldInfo | None, inside: list[str]) -> str:
    form = form_of(field) if field else None
    if form is not None:
        return form.form
    keys = f"a section with the keys {', '.join(inside)}"
    return f"{word_of(field)} or {keys}" if field and word_of(field) else keys


def missing_key(key: str, field: FieldInfo | None, place: Place, noun: str = "") -> InputError:
    """The error of a key that is needed and not there."""
    sections = sections_of(field) if field else []
    form = form_of(field) if field else None
    about = form.about if form else next((ABOUT[section] for section in sections), "")
    inside = [inner for section in sections for inner in fields_of(section)]
    what = f"'{key}' is missing" + (f" ({about})" if about else "")
    return InputError(what, where=noun or place.where, allowed=_form_text(field, inside), remedy="Add it.")
