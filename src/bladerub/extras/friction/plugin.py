"""The two laws of friction compared."""

SECTIONS = {"friction": "extras.friction.settings:FRICTION"}
COATINGS = {"friction": "extras.friction.coatings:compared"}
AGREEMENTS = {"friction": "extras.friction.coatings:problems"}
