import numpy as np
import pandas as pd
import pytest

import bladerub as br
from bladerub.study.job import compute_missing
from bladerub.study.plan import CoatingPlan, planned_run


@pytest.mark.extras
def test_progress_and_each_count_the_revolutions_and_a_speed_of_no_such_blade_is_named(study, blade, capsys):
    done = []
    asked = study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=2)
    br.simulate(blade, asked, follow=False, progress=True, each=done.append)
    assert done == [1, 2]
    said = capsys.readouterr().err
    assert said.lstrip("\r").startswith("compiling the time loop …")  # not a bar of one
    assert "rev" in said
    of_other_blade = study.replace("blade.length", 0.25).run("2nd", E=2, K=0.5, f_omega="2200 rpm")
    for refused in (study.run("2nd", E=2, K=0.5, f_omega=0.45), of_other_blade):
        with pytest.raises(br.InputError) as caught:
            br.simulate(blade, refused)
        assert caught.value.name == "f_omega"
    for n_modes in (0, -1, 2.5, 10**6):
        with pytest.raises(br.InputError, match="n_modes = "):
            blade.frequencies(0.1, n_modes)
    with pytest.raises(br.InputError, match="row = 5"):
        br.simulate(blade, asked, row=5)
    with pytest.raises(br.InputError, match="config = "):
        br.simulate(blade, asked, follow=False).summary(study)


def test_growing_run_is_followed_further(study, blade):
    asked, settings = study.run("2nd", E=2, K=0.5, f_omega=0.196), study.config.analysis.divergence
    run, short = br.simulate(blade, asked), br.simulate(blade, asked, follow=False)
    assert short.longer is None
    assert run.longer.revolutions == settings.confirmation_revolutions
    assert run.verdict().revolutions == run.longer.revolutions > short.verdict().revolutions


@pytest.mark.extras
def test_a_row_tells_of_each_blade(study, blade):
    row = br.Row.even(3, length=[0.0, 5e-5, -4e-3], frequency=[0.0, 0.01, 0.0])
    row_run = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=3), row=row)
    blades = row_run.blades
    assert blades.length.to_dict() == {1: 0.0, 2: 5e-5, 3: -4e-3}
    np.testing.assert_allclose(blades.frequency, [0.0, 0.01, 0.0], atol=1e-15)
    assert blades.worn_volume[3] == blades.peak[3] == 0
    assert blades.amplitude.idxmax() == row_run.attributes["blade"]
    assert row_run.revolution_amplitude.max() == blades.amplitude.max()
    assert row_run.energy.wear > 0
    assert row_run.attributes["energy_residual"] < 1e-3
    assert row_run.to_xarray()["blade_worn_volume"].dims == ("blade",)


@pytest.mark.extras
def test_rows_are_computed_once_and_again_when_their_blades_change(study, blade, tmp_path):
    planned = study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=3).of_length(blade.length)

    def made(row):
        lines = []
        coating = CoatingPlan(planned.case, (planned_run(planned.config, planned.spec, "0.h5", False, row),))
        compute_missing(planned.config, coating, blade.reduced, tmp_path, blade.digest, lines.append)
        return len(lines)

    row, other = (br.Row.drawn(2, 0, length_scatter=scatter) for scatter in (2e-5, 4e-5))
    assert made(row) == 1
    first = br.read_run(tmp_path / "0.h5")
    assert [made(each) for each in (row, other, row)] == [0, 1, 0]  # back from the archive
    pd.testing.assert_frame_equal(br.read_run(tmp_path / "0.h5").blades, first.blades)


@pytest.mark.extras
def test_the_run_with_its_stress_is_the_run(study, blade):
    asked = study.run("2nd", E=2, K=0.5, f_omega=0.19)
    run, stressed = br.simulate(blade, asked), br.simulate(blade, asked, stress=True)
    assert run.stress is None
    assert stressed.attributes["stress_last_von_mises"] == stressed.stress.last["von_mises"]
    for name in ("wear", "radial_displacement", "revolution_peak", "spectrum_amplitude"):
        np.testing.assert_array_equal(stressed.stored.data[name], run.stored.data[name])
