from bladerub.cli import main
from bladerub.config.read import read
from bladerub.io.folders import ROOT, study_folder


def test_a_new_study_has_the_config_of_the_paper(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "studies" / "own"
    assert main(["new", str(folder)]) == 0
    assert str(folder) in capsys.readouterr().out
    assert read(folder / "config" / "config.yaml") == read(ROOT / "config" / "config.yaml")
    assert {path.name for path in folder.iterdir()} >= {"Snakefile", "README.md", "config", "profiles"}
    monkeypatch.chdir(folder / "config")
    assert study_folder() == folder


def test_nothing_is_written_over(tmp_path, capsys):
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "file").touch()
    before = sorted(tmp_path.rglob("*"))
    for path in (tmp_path / "own", tmp_path / "own" / "file"):
        assert main(["new", str(path)]) == 2
        assert capsys.readouterr().err.startswith(f"bladerub new: {path}: ")
    assert sorted(tmp_path.rglob("*")) == before
