# The whole study on one page, to be opened in a browser from the file. It is not in Snakemake's report,
# which would hold another copy of it inside its own page.
from glob import glob
from os.path import relpath

from bladerub.study.grid import modulus_unit


rule explorer:
    input:
        accuracy=rules.blade.output.rom_accuracy,
        manifests=expand(rules.coating.output.manifest, coating=COATINGS),
        maps=expand(rules.coating.output.map, coating=COATINGS),
        peaks=rules.peaks.output[0],
        divergence=rules.divergence.output[0],
        # of the study `ensembles`, where it is there: bands of peaks and of runs
        bands=lambda wildcards: list(ADDED_TO_ALL.get("bands", []))[:2],
        packing=files_behind("extras.explorer.page"),
        page=sorted(glob("src/bladerub/extras/explorer/page/*")),
        analysing=files_behind("study.summary"),
        drawing=files_behind("plots.maps"),
    output:
        f"{RESULTS}/explorer.html",
    log:
        f"{RESULTS}/logs/explorer.log",
    benchmark:
        f"{RESULTS}/benchmarks/explorer.tsv"
    group:
        "drawing"
    params:
        settings={
            "max_frequency": config["figures"]["max_frequency"],
            "amplitude_range": config["figures"]["amplitude_range"],
            "growth_revolutions": config["analysis"]["divergence"]["revolutions"],
            "spectrum_revolutions": config["analysis"]["spectrum_revolutions"],
            "modulus_unit": modulus_unit(STUDY),
        },
        nominal_speed=config["figures"].get("nominal_speed"),
        configs=[relpath(path) for path in workflow.configfiles if path != "config/config.yaml"],
    script:
        "scripts/explorer.py"


ADDED_TO_ALL["explorer"] = rules.explorer.output
