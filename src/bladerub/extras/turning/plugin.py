"""A profile of the blade tip that turns with the blade."""

MOTIONS = {"tip_turns": "extras.turning"}
NEEDS = ("variants",)
