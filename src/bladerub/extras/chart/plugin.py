"""A chart of many coatings."""

MANIFESTS = {"columns": "extras.chart.point:PointRow"}
