"""NASA Rotor 37: reference numbers of contact with a rigid and with a coated casing."""
