# The whole study on one page, to be opened in a browser from the file. It has no place in Snakemake's report,
# which would hold another copy of it inside a page of its own.
from os.path import relpath


rule explorer:
    input:
        manifests=expand(rules.coating.output[0], coating=COATINGS),
        maps=expand(rules.map.output, coating=COATINGS),
        peaks=rules.peaks.output[0],
        divergence=rules.divergence.output[0],
        explaining=expand(
            "src/bladerub/explorer/{file}",
            file=[
                "codes.py",
                "coating.py",
                "figures.py",
                "inert.py",
                "page.py",
                "study.py",
                "thinning.py",
                "page/choice.js",
                "page/data.js",
                "page/index.html",
                "page/main.js",
                "page/pictures.js",
                "page/style.css",
                "page/words.js",
            ],
        ),
        analysing=files_behind("study.summary"),
        drawing=files_behind("plots.cells", "plots.spectrum_map", "plots.titles"),
    output:
        f"{RESULTS}/explorer.html",
    log:
        f"{RESULTS}/logs/explorer.log",
    benchmark:
        f"{RESULTS}/benchmarks/explorer.tsv"
    threads: 1
    params:
        settings={
            "max_frequency": config["figures"]["max_frequency"],
            "amplitude_range": config["figures"]["amplitude_range"],
            "growth_revolutions": config["analysis"]["divergence"]["revolutions"],
            "spectrum_revolutions": config["analysis"]["spectrum_revolutions"],
        },
        configs=[
            relpath(path)
            for path in workflow.configfiles
            if path != "config/config.yaml"
        ],
    script:
        "../scripts/explorer.py"
