"""Configuration of the manual. `build.py` lays out its pages and runs Sphinx."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import teeter  # noqa: E402

project = "Teeter"
author = "the authors of Teeter"
release = version = teeter.__version__
root_doc = "index"
language = "en"
# Quotes enclose values of arguments.
smartquotes = False

extensions = [
    "myst_nb",
    "sphinx_design",
    "sphinx.ext.autodoc",
    "package",
    "source_pages",
]
exclude_patterns = ["_build"]
nitpicky = True
# Names that docstrings link to must exist. Types of signatures may have no page: those of other
# packages, and those of the parts of a package.
nitpick_ignore_regex = [("py:.*", r"(?!teeter\.(errors\.)?[A-Z]\w*$).*")]
# A class that a package exports again has two pages; a link takes either.
suppress_warnings = ["ref.python"]

myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4
myst_url_schemes = ["http", "https", "mailto", "source"]
# Notebooks are stored with their outputs; the tests execute them.
nb_execution_mode = "off"
nb_merge_streams = True

autodoc_member_order = "groupwise"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True}
python_maximum_signature_line_length = 100
python_use_unqualified_type_names = True
toc_object_entries_show_parents = "hide"
add_module_names = False
highlight_language = "text"

html_theme = "furo"
html_title = f"Teeter {release}"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#8a4b12", "color-brand-content": "#8a4b12"},
    "dark_css_variables": {"color-brand-primary": "#e0a96d", "color-brand-content": "#e0a96d"},
}
pygments_style = "friendly"
pygments_dark_style = "monokai"
