import pytest

from bladerub.io import sources

FILES = {
    "study/__init__.py": "",
    "study/maps.py": "import numpy\nfrom bladerub.study import grid\nfrom bladerub.io import hdf5\n",
    "study/grid.py": "def f():\n    from bladerub.study.findings.claim import Claim\n    from . import x\n",
    "study/findings/__init__.py": "",
    "study/findings/claim.py": "from bladerub.study.maps import read_map\nfrom bladerub.contact import run\n",
    "study/peaks.py": "",
    "io/hdf5.py": "from bladerub.io import atomic\n",
    "io/atomic.py": "",
    "contact/run.py": "",
}


@pytest.fixture
def package(tmp_path, monkeypatch):
    package = tmp_path / "src" / "bladerub"
    for name, text in FILES.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    monkeypatch.setattr(sources, "PACKAGE", package)
    monkeypatch.chdir(tmp_path)


STUDY = ["study/__init__.py", "study/findings/claim.py", "study/grid.py", "study/maps.py"]


@pytest.mark.parametrize(
    ("modules", "behind"),
    [
        (["study.maps"], STUDY),
        (["study.maps", "io.hdf5"], ["io/atomic.py", "io/hdf5.py", *STUDY]),
        (["study.peaks"], ["study/peaks.py"]),
    ],
)
def test_imports_are_followed_within_the_subpackages_of_the_modules(package, modules, behind):
    assert sources.files_behind(*modules) == [f"src/bladerub/{name}" for name in behind]
