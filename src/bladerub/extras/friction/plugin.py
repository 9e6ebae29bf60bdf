"""The two laws of friction compared."""

SECTIONS = {"friction": "extras.friction.settings:FRICTION"}
AGREEMENTS = {"friction": "extras.friction.agreement:problems"}
