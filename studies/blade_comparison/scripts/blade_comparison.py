"""Compare the blade of a config with that of the study, and the coatings that both have."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.extras.blade_comparison import blades, runs
from bladerub.extras.blade_meshes import read_built
from bladerub.settings.study import typed
from bladerub.study.maps import read_map

built, reference = (read_built(Path(snakemake.input[name])) for name in ("blade", "reference"))
maps = [*map(read_map, snakemake.input.maps)]
half = len(maps) // 2
outputs.save(
    snakemake,
    blades=blades({"this": built, "reference": reference}),
    runs=runs(
        typed(snakemake.config),
        zip(maps[:half], maps[half:], strict=True),
        (built.reduced.length, reference.reduced.length),
    ),
)
