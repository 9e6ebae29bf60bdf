"""A chart of many coatings."""

SECTIONS = {"chart": "extras.chart.settings:CHART"}
AGREEMENTS = {"chart": "extras.chart.agreement:problems"}
MANIFESTS = {"columns": "extras.chart.point:PointRow"}
