"""Results remember the config that they were made with."""

RECORDS = {"config": "extras.records.record"}
