import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from bladerub.config.read import LaidOver
from bladerub.io.errors import BadInput
from bladerub.io.folders import ROOT
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.workflow import invocation


@pytest.mark.parametrize(
    ("name", "size"), [("0.1.h5", None), ("confirmation/0.2.h5", 9), ("confirmation/0.2.h5", 30)]
)
def test_a_run_that_is_missing_or_cut_short_is_a_loss(tmp_path, name, size):
    manifest, run = tmp_path / "manifest.tsv", tmp_path / name
    (tmp_path / "confirmation").mkdir()
    for file, length in (("0.1.h5", 10), ("0.2.h5", 20), ("confirmation/0.2.h5", 30)):
        (tmp_path / file).write_bytes(bytes(length))
    rows = [("0.1.h5", 0.1, "a", "completed", 10), ("0.2.h5", 0.2, "b", "completed", 20, "c", 30)]
    write_manifest(manifest, [ManifestRow(*row) for row in rows])
    run.unlink() if size is None else run.write_bytes(bytes(size))
    loss = invocation.loss(manifest)
    assert loss is None if size == 30 else str(run) in loss
    assert invocation.loss(manifest.with_name("none.tsv")) is None


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
    for name, extra in (("one", "cost.jobs"), ("two", "nowhere.table"), ("three", "chart.stress")):
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


@pytest.mark.parametrize("values", [["solver"], []])
def test_a_list_in_a_module_statement_is_no_config(values):
    with pytest.raises(BadInput, match=r"^config of the module: must hold keys, as config/config.yaml does$"):
        invocation.read_config(called_with([], {}, {}), values)
