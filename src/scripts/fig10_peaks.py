"""Fig. 10: maxima Y_k, f_k on the spectrum, and the amplitude along their engine orders (m)."""

import pandas as pd

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.peak_sections import PeakSection, peak_sections
from bladerub.study.maps import read_map
from bladerub.study.peaks import order_amplitude, peak, speed_window
from bladerub.workflow import job

job.log_to(snakemake.log[0])

coating, settings = read_map(snakemake.input.map), snakemake.params.peaks
sections = []
for k in settings["orders"][:2]:
    best = peak(coating, k, settings)
    amplitude = order_amplitude(coating, k, settings["order_halfwidth"])
    window = speed_window(coating, k, settings)
    sections.append(PeakSection(k, amplitude, window, best.f_omega, best.amplitude))

table = pd.concat(
    pd.DataFrame({"order": section.order, "f_omega": coating.f_omega, "amplitude": section.amplitude})
    for section in sections
)
tables.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")
figure = peak_sections(coating, sections, snakemake.params.amplitude_range, snakemake.params.max_frequency)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
