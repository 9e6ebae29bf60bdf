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


@pytest.mark.parametrize(
    ("mode", "speed_law", "tried"),
    [
        (6, {3: 0.0}, [(3, modes) for modes in range(6, 31, 2)]),  # thirty at a speed are the most
        (7, {3: 0.0}, [(3, 6)]),  # the first six count
        # a fit speed is added while eq. (2) has more than half of the tolerance
        (1, {3: 0.02, 4: 0.0051, 5: 0.0049}, [(3, 6), (4, 6), (5, 6), *((5, 8 + 2 * n) for n in range(12))]),
    ],
)
def test_what_is_tried_until_the_error_of_a_mode_is_allowed(monkeypatch, mode, speed_law, tried):
    found = []

    def reduce(n_speeds, config):
        found.append((n_speeds, config.reduction.modes_per_speed))
        table = pd.DataFrame({"mode": range(1, 9)}).assign(f_fe=1.0, f_fe_eq2=1.0, relative_error=0.0)
        errors = [1 + speed_law[n_speeds], 0.02 if found[-1][1] < 30 else 0.0]
        table.loc[table["mode"] == mode, ["f_fe_eq2", "relative_error"]] = errors
        return BuiltBlade(*[None] * 7, table, "")

    monkeypatch.setattr(refinement, "reduce", reduce)
    change = partial(refinement.reduce_to_tolerance, lambda n: n, most_fit_speeds=7)
    reduced(change, modes_per_speed=6, tolerance=0.01)
    assert found == tried
