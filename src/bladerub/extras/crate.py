"""A study as a Workflow RO-Crate: Snakefile, rules, config, and all results but the single runs."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rocrate.rocrate import ROCrate

from bladerub.io.folders import ROOT
from bladerub.io.provenance import provenance

WORKFLOW = {
    "name": "bladerub: contact of a compressor blade with its abradable coating",
    "description": "Builds a reduced blade, simulates its contact with coatings, collects maps and tables.",
}
FOLDERS = {  # by their names in the crate
    "src/rules": "Rules of the workflow",
    "src/scripts": "Scripts of its jobs",
    "src/report": "Captions of its figures",
    "studies": "Rules, scripts and captions of further studies",
    "config": "Config of the study and its schema",
    "results/blade": "Reduced model and mesh of the blade",
    "results/maps": "Wear and spectra over the speed, a file for each coating",
    "results/tables": (
        "Frequencies, peaks, divergence, verdicts on the claims; CSV with a description of each column"
    ),
    "results/figures": "Figures, PNG and PDF, with their data",
}


def pack(config: Mapping[str, Any], results: str, path: str) -> None:
    """Pack the study of this plain `config`, with its folder of `results`, into the file `path`."""
    crate = ROCrate()
    crate.name = "A study with bladerub"
    crate.description = (
        "Wear maps, spectra, peaks and verdicts on divergence, and the workflow that made them."
    )
    crate.license = "https://spdx.org/licenses/BSD-3-Clause"
    for name, value in provenance(config).items():
        entry = {"@id": f"#{name}", "@type": "PropertyValue", "name": name, "value": value}
        crate.root_dataset.append_to("additionalProperty", crate.add_jsonld(entry))
    crate.add_workflow("Snakefile", main=True, lang="snakemake", properties=WORKFLOW)
    for name, description in FOLDERS.items():
        place, _, folder = name.partition("/")
        source = {"results": Path(results, folder), "config": place}.get(place, ROOT / name)
        crate.add_directory(source, name, properties={"description": description})
    crate.write_zip(path)
