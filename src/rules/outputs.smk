# Where the rules write to, and what Snakemake's report (`snakemake --report report.html`) shows, in which order.
from typing import NamedTuple

from bladerub.io.sources import files_behind


report: "../report/workflow.rst"


TABLES = f"{RESULTS}/tables"
PLOTS = f"{RESULTS}/figures"
DPI = config["figures"]["dpi"]

CATEGORIES = {  # the report sorts them by name
    "Model": "1. Model",
    "Wear and spectra": "2. Wear and spectra",
    "Moduli of the coating": "3. Moduli of the coating",
    "Angle of the elements": "4. Angle of the elements",
    "Claims": "5. Claims",
}
CAPTIONS = {path.stem: path.as_posix() for path in ROOT.glob("studies/**/report/*.rst")}


def shown(path, name, category, title=None):
    """A file that the report shows; its name there is `title`, or the first line of its caption.

    The caption of a study is `report/<name>.rst` in its folder; it numbers categories of its own.
    """
    try:
        caption = CAPTIONS.get(name) or workflow.source_path(f"../report/{name}.rst")
        with open(caption, encoding="utf-8") as lines:
            title = title or next(lines).strip()
    except FileNotFoundError as error:
        where = f"studies/<its study>/report/{name}.rst, or src/report/{name}.rst for the core"
        raise WorkflowError(f"figure {name}: has no caption; write {where}, the title first") from error
    return report(
        path,
        caption=caption,
        category=CATEGORIES.get(category, category),
        labels={"what": title, "as": path.rsplit(".", 1)[-1]},
    )


def script_of(name):
    """The script of a rule that another folder may inherit (`use rule`), whose paths are relative to its own."""
    return workflow.source_path(f"../scripts/{name}.py")


def described(**tables):
    """Tables by name, each with the description of its columns that is written next to it."""
    descriptions = {f"{name}_description": f"{path}-metadata.json" for name, path in tables.items()}
    return tables | descriptions


def drawn(name, category=None, with_data=False):
    """The files of a figure, in the report if it has a category; further histories have one caption."""
    png, caption = f"{PLOTS}/{name}.png", "history" if name.startswith("history_") else name
    files = {"png": shown(png, caption, category) if category else png, "pdf": f"{PLOTS}/{name}.pdf"}
    return files | (described(data=f"{PLOTS}/{name}.csv") if with_data else {})


def drawn_together(names, category, with_data=True):
    """The files of figures that one job draws, each by the name of its figure and its kind."""
    return {
        f"{name}_{kind}": file for name in names for kind, file in drawn(name, category, with_data).items()
    }


class Picture(NamedTuple):
    """A committed picture of a figure."""

    figure: str
    colours: int
    shrink: int = 1  # over how many pixels it takes the mean


PICTURES = {}  # by the target that makes them: rules of studies add theirs


def minutes(first):
    """Time to ask a cluster for: at least three times what was measured."""
    return lambda wildcards, attempt: first * attempt
