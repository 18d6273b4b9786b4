"""Configuration of the documentation site: `make docs` builds it, and a warning is an error."""

import re

import macroslip

project = "macroslip"
author = "The macroslip developers"
project_copyright = "The macroslip developers; Apache-2.0"
release = version = macroslip.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "myst-nb", ".ipynb": "myst-nb"}
exclude_patterns = ["figures"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 4
# The notebooks are stored with their output; a test runs them again.
nb_execution_mode = "off"
napoleon_google_docstring = False
napoleon_use_rtype = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
# A block without a language is a command or plain text.
highlight_language = "none"
html_theme = "furo"
html_title = "macroslip"
html_show_sourcelink = False
# Furo's own fonts and the search index are files of the site: it works without a network.
html_static_path = []


def _links_to_sources(app: object, page: str, text: list[str]) -> None:
    """Turn links to files beside docs/, which a site does not have, into their paths in the source."""
    outside = r"\.\./\.\./" if page.startswith("notes/") else r"\.\./"
    text[0] = re.sub(r"\[(`?)([^\]`]+)`?\]\(" + outside + r"([^)]+)\)", _with_path, text[0])


def _with_path(link: re.Match) -> str:
    quote, words, path = link.groups()
    path = f"`{path.rstrip('/')}`"
    return path if quote else f"{words} ({path})"


def setup(app) -> None:
    """Register what changes pages as they are read."""
    app.connect("source-read", _links_to_sources)
