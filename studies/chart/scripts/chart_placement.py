"""Try the search of the chart on the maps of the study, which has every speed."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.chart.table import placement, placement_summary
from bladerub.settings.study import typed
from bladerub.study.maps import read_map

compared = placement(typed(snakemake.config), map(read_map, snakemake.input.maps))
outputs.save(snakemake, table=compared, summary=placement_summary(compared))
