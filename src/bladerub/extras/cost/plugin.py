"""What a study is going to cost, and what it has."""

FORECASTS = {"cost": "extras.cost.forecast"}
SCHEDULES = {"costs": "extras.cores:costs_of"}
