from functools import partial

import pandas as pd
import pytest
from blade_parts import TWISTED

from bladerub.blade.build import build
from bladerub.blade.built import BuiltBlade
from bladerub.extras.blade_doubts import errors_by_mode
from bladerub.extras.refinement import tolerance as refinement
from bladerub.settings.blade import BladeSpec, Reduction

REDUCTION = {"modes_per_speed": 2, "rank_tolerance": 1e-6, "accuracy_speeds": 5, "accuracy_modes": 7}
REDUCTION["f_omega_max"] = 0.8  # so fast that eq. (2) is not enough


def reduced(build=build, **changes):
    return build(BladeSpec(blade=TWISTED, reduction=Reduction(**REDUCTION | changes)))


def largest(built):
    return errors_by_mode(built.accuracy)[:6].max()


def test_speeds_or_modes_are_added_until_the_error_is_allowed():
    plain = reduced()
    tolerance = 0.2 * largest(plain).speed_law
    assert largest(plain).reduced_model > 2 * tolerance
    built = reduced(tolerance=tolerance)
    assert largest(built).reduced_model <= tolerance
    assert len(built.reduced.stiffness_higher) > 0
    assert built.made_from == reduced(tolerance=tolerance, accuracy_speeds=5).made_from != plain.made_from
    slow = {"f_omega_max": 0.05}
    plain = largest(reduced(**slow))
    assert plain.speed_law < 0.05 * plain.reduced_model
    built = reduced(**slow, tolerance=0.2 * plain.reduced_model)
    assert largest(built).reduced_model <= 0.2 * plain.reduced_model
    assert built.reduced.eta > 2
    assert built.reduced.stiffness_higher == ()


@pytest.fixture
def tried(monkeypatch):
    """Search for a reduction with given errors by (fit speeds, modes); return what was tried, in order."""

    def search(tolerance, speed_law, reduced_model, most_fit_speeds=7, mode=1):
        tried = []

        def reduce(n_speeds, config):
            tried.append((n_speeds, config.reduction.modes_per_speed))
            table = pd.DataFrame({"mode": range(1, 9)}).assign(f_fe=1.0, f_fe_eq2=1.0, relative_error=0.0)
            errors = [1 + speed_law(*tried[-1]), reduced_model(*tried[-1])]
            table.loc[table["mode"] == mode, ["f_fe_eq2", "relative_error"]] = errors
            return BuiltBlade(*[None] * 7, table, "")

        monkeypatch.setattr(refinement, "reduce", reduce)
        change = partial(refinement.reduce_to_tolerance, lambda n: n, most_fit_speeds=most_fit_speeds)
        reduced(change, modes_per_speed=6, tolerance=tolerance)
        return tried

    return search


def test_a_fit_speed_is_added_while_eq_2_has_more_than_half_of_the_tolerance(tried):
    law = {3: 0.02, 4: 0.0051, 5: 0.0049}
    found = tried(0.01, lambda n, _: law[n], lambda n, modes: 0.02 if modes < 10 else 0.01)
    assert found == [(3, 6), (4, 6), (5, 6), (5, 8), (5, 10)]


@pytest.mark.parametrize(("mode", "steps"), [(6, 13), (7, 1)])
def test_the_first_six_modes_count_and_thirty_at_a_speed_are_the_most(tried, mode, steps):
    def in_that_mode(_, modes):
        return 0.0 if modes == 30 else 0.02

    assert len(tried(0.01, lambda *_: 0.0, in_that_mode, mode=mode)) == steps
