import os
import platform
import subprocess

import pytest

from bladerub import __version__
from bladerub.io import provenance

git_state = provenance.git_state.__wrapped__  # without the cache
GIT = ["git", "-c", "user.name=t", "-c", "user.email=t@t", "-c", "commit.gpgsign=false"]
CONFIG = {"blade": {"length": 0.2, "eta": 6}, "coatings": [{"E": [11], "rigid": False}], "results": "results"}


@pytest.fixture
def repository(tmp_path, monkeypatch):
    for name in [name for name in os.environ if name.startswith("GIT_")]:
        monkeypatch.delenv(name)
    root = tmp_path / "repository"
    (root / "src").mkdir(parents=True)
    (root / "src" / "a.py").write_text("a = 1\n")
    (root / ".gitignore").write_text("results/\n")
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "first"]):
        subprocess.run([*GIT, *command], cwd=root, check=True)
    monkeypatch.setattr(provenance, "ROOT", root)
    return root


def head(root):
    output = subprocess.run([*GIT, "rev-parse", "HEAD"], cwd=root, check=True, capture_output=True, text=True)
    return output.stdout.strip()


def test_a_clean_repository_is_named_by_its_commit(repository):
    (repository / "results").mkdir()
    (repository / "results" / "run.h5").write_text("ignored")
    (repository / "my.yaml").write_text("the config has a digest of its own")
    assert git_state() == (head(repository), "clean")


@pytest.mark.parametrize("name", ["src/a.py", "src/new.py", ".gitignore"])
def test_an_edit_or_a_new_source_is_a_modification(repository, name):
    (repository / name).write_text("edited\n")
    assert git_state() == (head(repository), "modified")


@pytest.mark.parametrize("missing", ["repository", "commit", "git", "answer"])
def test_what_git_does_not_know_is_unknown(repository, tmp_path, monkeypatch, missing):
    if missing == "repository":  # it only lies in another's
        monkeypatch.setattr(provenance, "ROOT", repository / "src")
    elif missing == "commit":
        new = tmp_path / "new"
        subprocess.run([*GIT, "init", "-q", new], check=True)
        monkeypatch.setattr(provenance, "ROOT", new)
    elif missing == "git":
        monkeypatch.setenv("PATH", str(tmp_path))
    else:
        os.mkfifo(tmp_path / "silent")
        (tmp_path / "git").write_text(f"#!/bin/sh\nread answer < '{tmp_path / 'silent'}'\n")
        (tmp_path / "git").chmod(0o755)
        monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
        monkeypatch.setattr(provenance, "_SECONDS", 0.1)
    assert git_state() == ("unknown", "unknown")


def test_a_file_has_what_made_it_as_attributes(monkeypatch):
    monkeypatch.setattr(provenance, "git_state", lambda: ("abc", "clean"))
    output = provenance.provenance(CONFIG)
    packages = dict(entry.split("==") for entry in output.pop("provenance_packages").split())
    assert packages["python"] == platform.python_version()
    assert {"numpy", "scipy", "numba", "h5py", "scikit-fem", "rslab", "pandas"} <= packages.keys()
    assert output == {
        "provenance_software": f"bladerub {__version__}",
        "provenance_git_commit": "abc",
        "provenance_git_state": "clean",
        "provenance_config_sha256": provenance.config_digest(CONFIG),
    }
    assert provenance.software() == f"bladerub {__version__}, git commit abc (clean)"


def test_the_digest_is_of_what_a_config_says():
    digest = provenance.config_digest
    blade, coating = CONFIG["blade"], CONFIG["coatings"][0]
    same = [{"results": "other"}, {"blade": {"eta": 6.0, "length": 0.2}}]
    others = [{"blade": blade | {"length": 0.3}}, {"coatings": [coating | {"rigid": 0}]}]
    assert {digest(CONFIG | change) for change in same} == {digest(CONFIG)}
    assert len({digest(CONFIG | change) for change in (*others, {})}) == 3
