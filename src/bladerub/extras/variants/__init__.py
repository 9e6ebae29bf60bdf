"""The time loop for more than eight nodes of the tip, or with another law of the elements."""
