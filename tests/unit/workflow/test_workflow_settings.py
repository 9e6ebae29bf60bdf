"""Whose values are laid over the config of the study."""

from types import SimpleNamespace

from bladerub.config.record import Record
from bladerub.io.folders import ROOT
from bladerub.workflow import settings


def workflow(files=(), values=None):
    overwrite = {"solver": {"revolutions": 25}} if files else values or {}
    command_line = SimpleNamespace(configfiles=list(files), config=values or {}, overwrite_config=overwrite)
    return SimpleNamespace(config_settings=command_line, is_main_process=True)


def test_a_module_statement_is_laid_over_the_study(tmp_path, monkeypatch):
    given = {"solver": {"revolutions": 30}}
    for folder in (ROOT, tmp_path):  # there is a study, or none
        monkeypatch.chdir(folder)
        study, notes, laid_over = settings.read(workflow(values={"dpi": 3}), given)
        assert (study["solver"]["revolutions"], notes) == (30, [])
        assert laid_over == Record((), given)


def test_so_is_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    path = tmp_path / "my.yaml"
    path.write_text("solver: {revolutions: 25}\n")
    called = workflow([path])
    study, _, laid_over = settings.read(called, called.config_settings.overwrite_config)
    assert study["solver"]["revolutions"] == 25
    assert laid_over.files == [path]
