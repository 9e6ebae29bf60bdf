"""Fig. 8: spectrum of the blade on a soft coating.

The data are the map of its coating in ``maps/``.
"""

from bladerub.plots import style
from bladerub.plots.spectrum_map import spectrum_map
from bladerub.study.maps import read_map
from bladerub.workflow import job

job.log_to(snakemake.log[0])

figure = spectrum_map(
    read_map(snakemake.input.map), snakemake.params.amplitude_range, snakemake.params.max_frequency
)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
