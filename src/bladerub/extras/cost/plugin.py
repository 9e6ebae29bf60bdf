"""What a study is going to cost, and what it has."""

FORECASTS = {"cost": "extras.cost.forecast"}
