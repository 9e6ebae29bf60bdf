"""The engineer's page of the tiny study, by the command."""

import sys
from pathlib import Path

from bladerub.io import tables


def test_the_page_of_a_finished_study_needs_no_option(copied_study):
    done = copied_study.call(Path(sys.executable).with_name("bladerub"), "report")
    assert done.returncode == 0, done.stderr
    page = (copied_study.results / "report.html").read_text(encoding="utf-8")
    worst = tables.read(copied_study.results / "tables" / "peaks.csv").nlargest(1, "amplitude").iloc[0]
    assert f"The highest peak: {1e3 * worst.amplitude:.3g} mm at {worst.f_peak_rpm:,.0f} rpm" in page
    assert 'href="explorer.html"' in page
    assert len(page) < 5e6
