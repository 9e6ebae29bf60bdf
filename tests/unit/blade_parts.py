from bladerub.settings.blade import Material, Mesh, Reduction, SpanSection
from bladerub.settings.study import whole

REDUCTION = Reduction(
    f_omega_max=0.4, modes_per_speed=3, rank_tolerance=1e-5, accuracy_speeds=3, accuracy_modes=8
)
TITANIUM = Material(young_modulus=110e9, poisson_ratio=0.32, density=4430.0)


def section(span, **changes):
    standard = {"chord": 0.08, "thickness": 0.08, "camber": 0.0, "stagger": 0.0, "sweep": 0.0, "lean": 0.0}
    return SpanSection.model_construct(span=span, **standard | changes)


BLADE = whole().model_fields["blade"].annotation  # a source may plug in
TWISTED = BLADE(
    material=TITANIUM,
    hub_radius=0.45,
    length=0.2,
    tip_cone=0.0,
    sections=[
        section(0.0, thickness=0.1, camber=35.0, stagger=20.0),
        section(1.0, chord=0.075, thickness=0.05, camber=10.0, stagger=50.0, sweep=-0.004, lean=0.003),
    ],
    mesh=Mesh(chordwise=7, thickness=1, spanwise=3),
)
