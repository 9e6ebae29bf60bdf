"""What the scripts of the rules write: tables that say what made them, and figures."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bladerub import plugins
from bladerub.io import tables
from bladerub.io.provenance import provenance

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from bladerub.plots.scales import Scales


def save(
    snakemake: Any,
    figure: "Figure | None" = None,
    prefix: str = "",
    origin: Mapping[str, str] | None = None,
    digits: str | None = None,
    **frames: "pd.DataFrame",
) -> None:
    """Write the outputs of a job, whose `snakemake` is what Snakemake hands to a script.

    The figure goes to the outputs ``png`` and ``pdf`` with the parameter ``dpi``, each table to the output of
    its name; that of a figure, ``data``, is written to six digits, others to `digits`, a format of pandas.
    Columns are described in ``columns.csv`` of the study of the script, of the core or of an extra. Names of
    outputs begin with `prefix` where a job draws several figures. `origin` is as of
    `bladerub.io.tables.write`, by default of the study at work.
    """
    made_from = origin or provenance(snakemake.config)
    of_study = Path(snakemake.scriptdir).parent / tables.COLUMNS_FILE.name
    columns_files = [*([of_study] if of_study.is_file() else []), *plugins.files(of_study.name)]
    for name, table in frames.items():
        form = "%.6g" if name == "data" else digits
        tables.write(snakemake.output[prefix + name], table, made_from, form, columns_files)
    if figure is not None:
        from bladerub.plots import style  # imports Matplotlib, which jobs of tables do without

        files = (snakemake.output[prefix + kind] for kind in ("png", "pdf"))
        style.save(figure, *files, snakemake.params["dpi"])


def f1_hz(snakemake: Any) -> float:
    """Read the first frequency at rest of the input ``blade`` of a job."""
    from bladerub.io import hdf5  # takes long, and a job opens its log before

    return float(hdf5.read_attributes(snakemake.input.blade)["f1_hz"])


def scales(snakemake: Any) -> "Scales":
    """Tell a figure what its numbers are: `f1_hz` of a job, and its parameter ``scales`` if it has one."""
    from bladerub.plots.scales import Scales

    return Scales(f1_hz=f1_hz(snakemake), **snakemake.params.get("scales", {}))
