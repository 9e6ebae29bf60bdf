import ast
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pandas as pd
import pytest
from matplotlib.image import imread

from bladerub.config.read import LaidOver
from bladerub.io import tables
from bladerub.io.errors import BadInput
from bladerub.io.folders import ROOT
from bladerub.plots import style
from bladerub.workflow import invocation, outputs

SCRIPT = """
import sys
from bladerub.workflow import job
from bladerub.io.errors import DamagedFile
job.log_to(sys.argv[1])
print("at work", file=sys.stderr)
{}
"""
SCRIPTS = sorted([*Path("src/scripts").glob("*.py"), *Path("studies").glob("*/scripts/*.py")])
TABLE = pd.DataFrame({"f_omega": [0.1234567891], "theta": [0.15]})


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ('raise DamagedFile("a.h5: not a map")', "a.h5: not a map; delete it and run the same command again"),
        ("1 / 0", "bladerub: division by zero"),  # a reason on the screen, whatever it is
    ],
)
def test_an_error_is_one_line_for_the_caller_and_the_traceback_of_another_is_in_the_log(
    tmp_path, statement, said
):
    log = tmp_path / "job.log"
    arguments = [sys.executable, "-c", SCRIPT.format(statement), str(log)]
    done = subprocess.run(arguments, capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr.startswith(said)
    assert done.stderr.count("\n") == 1
    text = log.read_text()
    assert text.startswith("at work\nTraceback" if statement == "1 / 0" else f"at work\n{done.stderr}")
    assert text.endswith("ZeroDivisionError: division by zero\n") == (statement == "1 / 0")


def test_the_log_of_a_job_is_open_before_its_imports():
    """So that it has their errors, and the traceback of an interrupt, which takes them where it can."""
    assert len(SCRIPTS) > 10
    for script in SCRIPTS:
        _, imported, opened = map(ast.unparse, ast.parse(script.read_text(encoding="utf-8")).body[:3])
        assert imported.removesuffix(", outputs") == "from bladerub.workflow import job", script
        assert opened == "job.log_to(snakemake.log[0])", script


def test_jobs_and_the_command_line_start_without_numpy():
    program = "from bladerub import cli; from bladerub.workflow import job, outputs"
    program = f"import sys; {program}; print('numpy' in sys.modules)"
    assert subprocess.check_output([sys.executable, "-c", program], text=True) == "False\n"


def test_tables_and_figure_go_to_their_outputs(tmp_path):
    paths = {name: str(tmp_path / f"a.{name}") for name in ("png", "pdf")}
    paths |= {name: str(tmp_path / f"{name}.csv") for name in ("table", "data")}
    job = SimpleNamespace(output=paths, config={"seed": 1}, params={"dpi": 70}, scriptdir="scripts")
    outputs.save(job, style.new_figure(2, 1), table=TABLE, data=TABLE)
    assert imread(job.output["png"]).shape[:2] == (70, 140)
    assert Path(job.output["pdf"]).read_bytes().startswith(b"%PDF")
    pd.testing.assert_frame_equal(tables.read(job.output["table"]), TABLE, check_exact=True)
    assert tables.read(job.output["data"])["f_omega"].tolist() == [0.123457]


def test_a_figure_imports_neither_the_solver_nor_parts_of_scipy_it_may_not_need():
    """A study draws a hundred, each by a job that imports anew."""
    program = (
        "import sys; import bladerub.plots.maps, bladerub.study.peaks, bladerub.workflow.outputs; "
        "print([name for name in ('numba', 'scipy.linalg', 'scipy.ndimage', 'skfem') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_the_rules_do_not_import_the_compiler():
    """Each call of snakemake would wait for it, and each of its jobs on a cluster."""
    imports = re.compile(r"^(?:import bladerub.*|from bladerub\S* import (?:\([^)]*\)|.*))$", re.M)
    texts = [
        path.read_text(encoding="utf-8")
        for path in (Path("Snakefile"), *Path("src/rules").iterdir(), *Path("studies").glob("*/rules.smk"))
    ]
    statements = [statement for text in texts for statement in imports.findall(text)]
    assert "from bladerub.workflow import invocation" in statements
    program = "\n".join([*statements, "import sys", "print('numba' in sys.modules)"])
    assert subprocess.check_output([sys.executable, "-c", program], text=True) == "False\n"


@pytest.mark.extras
def test_a_study_without_its_extra_is_left_out(tmp_path):
    for name, extra in (("one", "cost.jobs"), ("two", "nowhere.table"), ("three", "chart.table")):
        (tmp_path / "studies" / name / "scripts").mkdir(parents=True)
        (tmp_path / "studies" / name / "rules.smk").write_text(f'files_behind("extras.{extra}")\n')
    script = tmp_path / "studies" / "three" / "scripts" / "three.py"
    script.write_text("from bladerub.extras.lost import table\n")
    complete, notes = invocation.rules_of_studies(tmp_path)
    assert [path.parent.name for path in complete] == ["one"]
    assert notes == [
        "without the study three, which needs bladerub.extras.lost",
        "without the study two, which needs bladerub.extras.nowhere",
    ]


def called_with(files, values, all_values):
    """What `read_config` sees of a workflow that was called with these configs."""
    command_line = SimpleNamespace(configfiles=files, config=values, overwrite_config=all_values)
    return SimpleNamespace(config_settings=command_line, is_main_process=True)


@pytest.mark.parametrize("by_file", [False, True])
def test_a_module_statement_and_the_command_line_are_laid_over_the_study(tmp_path, monkeypatch, by_file):
    path, given = tmp_path / "my.yaml", {"solver": {"revolutions": 30}}
    path.write_text("solver: {revolutions: 30}\n")
    files, values = ([path], {}) if by_file else ([], {"dpi": 3})
    workflow = called_with(files, values, given if files else values)
    for folder in [ROOT] if by_file else [ROOT, tmp_path]:  # there is a study, or none
        monkeypatch.chdir(folder)
        study, notes, laid_over = invocation.read_config(workflow, given)
        assert (study.solver.revolutions, notes) == (30, [])
        assert list(laid_over.files) == [*map(str, files)]
        assert by_file or laid_over == LaidOver((), given)


def test_a_mistake_in_a_module_statement_is_said_to_be_there(monkeypatch):
    monkeypatch.chdir(ROOT)
    with pytest.raises(BadInput, match=r"^config of the module: solver.revolutions = 0: "):
        invocation.read_config(called_with([], {}, {}), {"solver": {"revolutions": 0}})
