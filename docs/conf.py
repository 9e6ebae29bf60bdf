"""Configuration of the site; from the repository's root: `sphinx-build -W -b html docs docs/_build/html`."""

import os
import sys
from pathlib import Path

import bladerub

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent)]  # for the extensions here; docs.numbers
os.environ.setdefault("BLADERUB_CACHE", str(HERE / "_build" / "cache"))  # examples share a blade

EXPLORER = HERE.parent / "results" / "explorer.html"  # of `snakemake`, if it was run before
if EXPLORER.exists():
    html_extra_path = [str(EXPLORER)]

project = "bladerub"
author = "The bladerub authors"
copyright = author
release = bladerub.__version__

extensions = [
    "myst_parser",  # pages in Markdown
    "research_notes",  # those of studies, and links
    "docs.numbers",  # what they quote by name
    "sphinx.ext.autosummary",  # API
    "numpydoc",  # its docstrings
    "sphinxarg.ext",  # commands, from their parsers
    "sphinx_gallery.gen_gallery",  # examples, executed
]
exclude_patterns = ["_build", "_templates", "gallery"]
nitpicky = True
suppress_warnings = ["toc.empty_glob"]  # of research notes, where there are no studies

myst_enable_extensions = ["colon_fence", "deflist", "substitution"]
myst_heading_anchors = 3  # links to headings, as GitHub makes them

autodoc_typehints = "none"  # docstrings have shapes and units as well
numpydoc_show_class_members = False

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "auto_gallery",
    "filename_pattern": r".*\.py",
    "copyfile_regex": r".*\.rst",
    "download_all_examples": False,
    "show_signature": False,
    "write_computation_times": False,
    "abort_on_example_error": True,
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": ("matplotlib", "gallery_pictures.scrape"),
    "ignore_repr_types": r"Figure|Picture|matplotlib|list|int",  # what is shown as a picture already
}

html_theme = "pydata_sphinx_theme"
html_title = "bladerub"
html_static_path = ["_static"]
html_css_files = ["bladerub.css"]
html_sidebars = {"**": ["pages.html"]}
templates_path = ["_templates"]
html_theme_options = {"navbar_center": [], "navigation_with_keys": False, "show_toc_level": 2}
html_theme_options |= {"secondary_sidebar_items": ["page-toc"]}
html_theme_options |= {"footer_start": ["copyright"], "footer_end": []}
html_show_sourcelink = html_copy_source = False


def _link_explorer(app, docname, source):
    """Link to the explorer of the site, which the repository does not have."""
    if docname == "how-to/report":
        source[0] += '\n<a href="../explorer.html">The explorer of a small study</a> is part of this site.\n'


def setup(app):
    """Connect what depends on the results that are there."""
    if EXPLORER.exists():
        app.connect("source-read", _link_explorer)
