"""The works a result rests on as BibTeX."""

from __future__ import annotations

import re
from collections.abc import Iterable

import macroslip

#: Fields of works that the package cites, by a part of the citation that names them.
_KNOWN = {
    "Dynamic modelling of slip in a wind turbine spherical roller main bearing": (
        "misc",
        "hart_slip",
        {
            "author": "Hart, E. and others",
            "title": "Dynamic modelling of slip in a wind turbine spherical roller main bearing",
        },
    ),
    "10.1017/CBO9781139171731": (
        "book",
        "johnson_1985",
        {
            "author": "Johnson, K. L.",
            "title": "Contact Mechanics",
            "publisher": "Cambridge University Press",
            "year": "1985",
            "doi": "10.1017/CBO9781139171731",
        },
    ),
    "10.1007/978-3-642-05221-7": (
        "book",
        "hairer_wanner_1996",
        {
            "author": "Hairer, E. and Wanner, G.",
            "title": "Solving Ordinary Differential Equations {II}: Stiff and Differential-Algebraic Problems",
            "publisher": "Springer",
            "year": "1996",
            "doi": "10.1007/978-3-642-05221-7",
        },
    ),
    "10.1098/rsta.1961.0014": (
        "article",
        "crook_1961",
        {
            "author": "Crook, A. W.",
            "title": "The lubrication of rollers {III}. A theoretical discussion of friction and the temperatures in the "
            "oil film",
            "journal": "Philosophical Transactions of the Royal Society A",
            "volume": "254",
            "pages": "237--258",
            "year": "1961",
            "doi": "10.1098/rsta.1961.0014",
        },
    ),
    "10.1115/1.4005514": (
        "article",
        "masjedi_khonsari_2012",
        {
            "author": "Masjedi, M. and Khonsari, M. M.",
            "title": "Film Thickness and Asperity Load Formulas for Line-Contact Elastohydrodynamic Lubrication With "
            "Provision for Surface Roughness",
            "journal": "Journal of Tribology",
            "volume": "134",
            "pages": "011503",
            "year": "2012",
            "doi": "10.1115/1.4005514",
        },
    ),
}
_DOI = re.compile(r"doi:\s*(10\.\S+?)[.;,)]?(?=\s|$)")


def bibtex(citations: Iterable[str]) -> str:
    """BibTeX entries of the program and of the works cited.

    Parameters
    ----------
    citations : iterable of str
        As the attribute `citations` of a result lists them, one work each. A work that is not known by name becomes an
        entry of type `misc` with the citation as its note, and its DOI if it has one.

    Examples
    --------
    >>> print(bibtex(["A. Author, A title, doi:10.1000/182"]).split("@")[2].strip())
    misc{author_a_title,
      note = {A. Author, A title, doi:10.1000/182},
      doi = {10.1000/182}
    }
    """
    own = {"title": "macroslip: slip of the rollers of a wind turbine's main bearing", "version": macroslip.__version__}
    entries = {"macroslip": _entry("software", "macroslip", own)}
    for citation in citations:
        for mark, (kind, key, fields) in _KNOWN.items():
            if mark in citation:
                entries[key] = _entry(kind, key, fields)
                break
        else:
            if citation.strip():
                doi = _DOI.search(citation)
                fields = {"note": citation.strip()} | ({"doi": doi.group(1)} if doi else {})
                key = "_".join(re.findall(r"[A-Za-z]{2,}|a(?= )", citation.lower())[:3]) or "work"
                key = key if key not in entries else f"{key}_{len(entries)}"
                entries[key] = _entry("misc", key, fields)
    return "\n\n".join(entries.values())


def _entry(kind: str, key: str, fields: dict[str, str]) -> str:
    # Braces of an unknown text would end the field.
    lines = [
        f"  {name} = {{{value if value.count('{') == value.count('}') else re.sub('[{}]', '', value)}}}"
        for name, value in fields.items()
    ]
    return f"@{kind}{{{key},\n" + ",\n".join(lines) + "\n}"
