"""Rows of blades that rub on one coating."""

PUBLIC = dict.fromkeys(("Disk", "Row", "RowBlade"), "extras.rows.spec")
SECTIONS = {"rotor": "extras.rows.settings:Rotor"}
AGREEMENTS = {"rotor": "extras.rows.study:problems"}
ROWS = {"rotor": "extras.rows.study"}
DATASETS = {"rows": "extras.rows.study:DATASETS"}
RUN_OPTIONS = {"row": "extras.rows.run_option:RowOption"}
