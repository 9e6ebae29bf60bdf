"""A profile of the blade tip that turns with the blade (``contact.tip_turns``)."""
