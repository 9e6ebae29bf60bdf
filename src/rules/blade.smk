# Stage 1: the blade, built once: finite elements, reduction, accuracy of the reduction.

from bladerub.blade.sources.origin import files
from bladerub.io.sources import files_behind


rule blade:
    input:
        code=files_behind("blade.build"),
        given=files(config["blade"]["source"]) if "source" in config["blade"] else [],
    output:
        reduced_model=f"{config['results']}/blade/reduced_model.h5",
        mesh=f"{config['results']}/blade/mesh.h5",
        campbell=f"{config['results']}/tables/campbell.csv",
        rom_accuracy=f"{config['results']}/tables/rom_accuracy.csv",
        descriptions=[
            f"{config['results']}/tables/{name}.csv-metadata.json"
            for name in ("campbell", "rom_accuracy")
        ],
    log:
        f"{config['results']}/logs/blade.log",
    benchmark:
        f"{config['results']}/benchmarks/blade.tsv"
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: 2000 * attempt,  # 500 measured, and a finer mesh needs more
        runtime=lambda wildcards, attempt: 10 * attempt,
    params:
        blade=config["blade"],
        reduction=config["reduction"],
    script:
        "../scripts/blade.py"
