"""Direction of the contact force: turned by θ against the rotation, or by Coulomb's law against the sliding.

A force of constant direction is turned by θ against the rotation whatever the tip does. Coulomb's opposes the
sliding of the tip over the casing: rotation and vibration together. With the coefficient μ = tan θ its normal
part is ``N cos θ`` for the force N of the elements, as under θ, and its tangential part ``m N sin θ`` with a
mobilisation m from −1 to 1: 1 where the tip slides with the rotation, −1 where it slides back, between where
it sticks. Where rotation always prevails, m is 1 throughout, and both laws are one.

The mobilisation is found with the forces of a step: from the distance s that the tip would slide in this step
without friction, it is ``s / (γ N sin θ)``, limited to [−1, 1]. γ is the most that friction of 1 N under all
nodes takes from the sliding of each, so that no step overshoots: a single mass comes to rest in the step in
which it would turn, and nodes that hinder each other within a few. That needs no velocity below which
friction fades; as the step goes to zero it becomes the jump of Coulomb's law.

The distance is counted as the scheme counts the work of its forces (`bladerub.contact.schemes`, contract 5),
over the modes that it resolves: there friction of all nodes together never drives the tip. Condensed modes
have no velocity, and what they store of friction they give back.
"""

from bladerub.numerics.vectors import elementwise, where


@elementwise
def contact_force(normal_factor, tangential_factor, normal_radial, normal_tangential, normal_force):
    """Split the contact force on the blade, F_r = −cos θ |F| e_r and F_θ = −sin θ |F| e_θ of the paper.

    Both directions are those at the displaced node, given by the normal of the casing there; the result is by
    the node's own directions at rest (radial, tangential, N). The factors are −cos θ, and −sin θ or what
    friction mobilises of it; `normal_force` is the force N of the elements (N).
    """
    return (
        normal_force * (normal_factor * normal_radial - tangential_factor * normal_tangential),
        normal_force * (normal_factor * normal_tangential + tangential_factor * normal_radial),
    )


@elementwise
def mobilisation(sliding, stopping):
    """Share m of the friction that Coulomb's law mobilises.

    `sliding` is the distance s that the tip would slide in this step without friction, `stopping` is γ N
    sin θ, the most that friction takes from it (m).
    """
    return where(sliding > stopping, 1.0, where(sliding > (0.0 - stopping), sliding / stopping, -1.0))
