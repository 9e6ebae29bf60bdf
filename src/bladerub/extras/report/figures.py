"""Figures of the page: those of the study, in rpm and Hz, inside the text of the page."""

from base64 import b64encode
from io import BytesIO, StringIO

import matplotlib
from matplotlib.figure import Figure

from bladerub.extras.report.results import Results
from bladerub.plots import campbell as frequencies
from bladerub.plots.scales import Engine, Scales
from bladerub.plots.spectrum import ORDERS, spectrum_map
from bladerub.plots.style import RED
from bladerub.plots.wear_map import wear_map
from bladerub.study.grid import modulus_unit

_DPI = 110
_SAME = {"svg.hashsalt": "bladerub", "svg.fonttype": "path"}  # equal results have equal pages


def campbell(results: Results) -> str:
    """Draw the Campbell diagram with the peaks of all coatings, as SVG."""
    modes = results.campbell.pivot(index="f_omega", columns="mode") / results.f1_hz
    figure = frequencies.campbell(modes.index, modes["f_fe"], modes["f_rom"], ORDERS, _engine(results))
    peaks = results.peaks.dropna(subset=["f_peak"])
    look = {"linestyle": "none", "marker": "o", "fillstyle": "none", "markersize": 5, "color": RED}
    figure.axes[-1].plot(peaks.f_peak, peaks.order * peaks.f_peak, label="_peaks", zorder=4, **look)
    stream = StringIO()
    with matplotlib.rc_context(_SAME):
        figure.savefig(stream, format="svg", metadata={"Date": None})
    svg = stream.getvalue()
    label = 'role="img" aria-label="Campbell diagram"'
    return svg[svg.index("<svg") :].replace("<svg", f"<svg {label}", 1)


def maps(results: Results, name: str) -> dict[str, str]:
    """Draw wear and spectra of a coating over the speed, as addresses of PNGs that hold them, by caption."""
    config, coating = results.config, results.map(name)
    scales = Scales(modulus_unit(config), config["blade"]["length"], _engine(results))
    ends, highest = config["figures"]["amplitude_range"], config["figures"]["max_frequency"]
    return {
        "Worn depth around the casing over the speed": _png(wear_map(coating, scales)),
        "Vibration over frequency and speed": _png(spectrum_map(coating, tuple(ends), highest, scales)),
    }


def _engine(results: Results) -> Engine:
    return Engine(results.f1_hz, results.config["figures"].get("nominal_speed"))


def _png(figure: Figure) -> str:
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=_DPI, metadata={"Software": None})
    return f"data:image/png;base64,{b64encode(stream.getvalue()).decode()}"
