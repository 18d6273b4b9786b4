"""Configuration of the documentation site: `make docs` builds it, and a warning is an error."""

import macroslip

project = "macroslip"
author = "The macroslip developers"
project_copyright = "The macroslip developers; Apache-2.0"
release = version = macroslip.__version__

source_suffix = {".md": "markdown"}
exclude_patterns = ["figures"]
myst_enable_extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_heading_anchors = 4
napoleon_google_docstring = False
napoleon_use_rtype = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
html_theme = "furo"
html_title = "macroslip"
html_show_sourcelink = False
nitpicky = False
