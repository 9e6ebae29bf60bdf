"""Pictures of the gallery: what a block of an example ends with, if it is a figure of the package."""

from sphinx_gallery.scrapers import figure_rst

from bladerub.plots.style import Picture

_DPI = 130


def scrape(block, block_vars, gallery_conf):
    """Write the figure that the last line of a block gives, once; return the text that shows it."""
    last = block_vars["example_globals"].get("___")
    if not isinstance(last, Picture) or getattr(last, "shown", False):
        return ""
    last.shown = True
    path = next(block_vars["image_path_iterator"])
    last.savefig(path, dpi=_DPI)
    return figure_rst([path], gallery_conf["src_dir"])
