"""Fig. 10: maxima Y_k, f_k on the spectrum, and the amplitude along their orders (m)."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import pandas as pd

from bladerub.plots.spectrum import PeakSection, peak_sections
from bladerub.settings.analysis import Peaks
from bladerub.study.maps import read_map
from bladerub.study.peaks import order_amplitude, peak, speed_window
from bladerub.workflow import outputs

coating, settings = read_map(snakemake.input.map), Peaks(**snakemake.params.peaks)
sections = [
    PeakSection(
        order,
        order_amplitude(coating, order, settings.order_halfwidth),
        speed_window(coating, order, settings),
        peak(coating, order, settings),
    )
    for order in settings.orders[:2]
]
table = pd.concat(
    pd.DataFrame({"order": section.order, "f_omega": coating.f_omega, "amplitude": section.amplitude})
    for section in sections
)
look = snakemake.params.amplitude_range, snakemake.params.max_frequency
figure = peak_sections(coating, sections, *look, outputs.scales(snakemake))
outputs.save(snakemake, figure, data=table)
