"""Stress of the blade at the peaks, by the real workflow."""

from bladerub.io import tables


def test_each_peak_has_its_stress(copied_study, tiny):
    assert copied_study.plan(tiny, "stress") == {"stress": 1}
    copied_study.build(tiny, "stress")
    peaks = tables.read(copied_study.results / "tables" / "peaks.csv")
    stress = tables.read(copied_study.results / "tables" / "stress.csv")
    assert stress.f_peak.tolist() == peaks.f_peak.dropna().tolist()
    assert (stress.rotation_von_mises > 0).all()
    assert (stress.last_von_mises > stress.rotation_von_mises).all()
    assert copied_study.plan(tiny, "stress") == {}
