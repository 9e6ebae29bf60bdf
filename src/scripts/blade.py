"""Rule `blade`: build the blade, write the reduced model, the mesh and the table of its accuracy."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import logging
from pathlib import Path

from bladerub.blade.build import build
from bladerub.blade.built import write
from bladerub.blade.frequencies import doubts
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed

logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(message)s")
logging.getLogger("bladerub").setLevel(logging.INFO)

# of the study, or of a sample of the robustness
plain = {**snakemake.config, "blade": snakemake.params.blade, "reduction": snakemake.params.reduction}
config = typed(plain)
reduced_model = Path(snakemake.output.reduced_model)
built = build(config)
write(built, provenance(plain), reduced_model)
for doubt in doubts(built.accuracy, config.figures.nominal_speed):
    job.print_doubt(f"{reduced_model}: {doubt}")
