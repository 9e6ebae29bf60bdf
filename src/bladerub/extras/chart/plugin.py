"""A chart of many coatings."""

SECTIONS = {"chart": "extras.chart.settings:CHART"}
AGREEMENTS = {"chart": "extras.chart.plan:problems"}
MANIFESTS = {"columns": "extras.chart.point:PointRow"}
