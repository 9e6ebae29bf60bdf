import dataclasses
from pathlib import Path

from bladerub.study.confirmation import confirmation_path, confirmation_spec, determinants


def test_the_longer_run_is_the_same_run_for_longer(spec, config):
    longer = confirmation_spec(spec, config["analysis"]["divergence"])
    assert longer.revolutions == 60
    assert dataclasses.replace(longer, revolutions=spec.revolutions) == spec


def test_it_lies_beside_the_runs():
    assert confirmation_path("runs/2nd/0.1900.h5") == Path("runs/2nd/confirmation/0.1900.h5")


def test_every_setting_decides_which_runs_are_repeated_and_none_where_none_is(config):
    settings = config["analysis"]["divergence"]
    before = determinants(settings)
    for name, value in settings.items():
        assert determinants(settings | {name: 2 * value}) != before
    off = settings | {"confirmation_revolutions": 0}
    assert determinants(off) == determinants(off | {"growth": 0.5}) == {}
