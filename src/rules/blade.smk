# Stage 1: the blade, built once: finite elements, reduction, accuracy of the reduction.

from bladerub.blade.source.origin import files


rule blade:
    input:
        # Snakemake does not follow imports: an edit of these changes the blade.
        expand(
            "src/bladerub/{module}.py",
            module=[
                "datafile",
                "blade/accuracy",
                "blade/adaptive",
                "blade/build",
                "blade/coordinates",
                "blade/discrete",
                "blade/elasticity",
                "blade/frequencies",
                "blade/geometry",
                "blade/linear",
                "blade/mesh",
                "blade/model",
                "blade/nearby",
                "blade/reduction",
                "blade/rotation",
                "blade/source/abaqus",
                "blade/source/definite",
                "blade/source/frame",
                "blade/source/imported",
                "blade/source/importing",
                "blade/source/matrices",
                "blade/source/matrix_folder",
                "blade/source/mesh_file",
                "blade/source/node_sets",
                "blade/source/origin",
                "blade/source/profile",
                "blade/source/section_blade",
                "blade/source/section_profile",
                "blade/source/section_table",
                "blade/source/soundness",
                "blade/source/tip",
                "blade/surface",
            ],
        ),
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
