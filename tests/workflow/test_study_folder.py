"""A study of one's own is one folder: rules, script, caption and columns."""

from bladerub.io import tables

FILES = {
    "rules.smk": """
rule own:
    output:
        **drawn("own", "Of my own"),
        **described(table=f"{TABLES}/own.csv"),
    params:
        dpi=DPI,
    script:
        "scripts/own.py"
""",
    "scripts/own.py": """
import pandas as pd

from bladerub.plots import style
from bladerub.workflow import outputs

outputs.save(snakemake, style.new_figure(2, 1), table=pd.DataFrame({"own": [1.0]}))
""",
    "report/own.rst": "Nothing but a frame\n",
    "columns.csv": "column,datatype,unit,description\nown,number,m,of this study alone\n",
}


def test_a_folder_is_all_that_a_study_needs(workspace, tiny):
    for name, text in FILES.items():
        path = workspace.folder / "studies" / "own" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    workspace.build(tiny, "own")
    assert (workspace.results / "figures" / "own.png").is_file()
    table = workspace.results / "tables" / "own.csv"
    assert tables.read(table)["own"].tolist() == [1.0]
    assert "of this study alone" in tables.description_path(table).read_text(encoding="utf-8")
