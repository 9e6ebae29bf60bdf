import pytest

from bladerub.contact.laws import solver_digest
from bladerub.extras.chart import column
from bladerub.extras.gpu import solver
from bladerub.io import sources
from bladerub.study.growth import growth_digest
from bladerub.study.plan import storage_digest

SOLVER, STORAGE, GROWTH = solver_digest, storage_digest, growth_digest
GPU, CHART = solver.gpu_digest.__wrapped__, column.chart_digest
EDITS = [  # the file, the digest that it belongs to, one that it does not
    ("contact/run.py", SOLVER, STORAGE),
    ("contact/kernel/run.py", SOLVER, STORAGE),
    ("blade/model.py", SOLVER, GPU),
    ("extras/gpu/loop.cu", GPU, SOLVER),
    ("extras/gpu/new.py", GPU, SOLVER),
    ("study/store.py", STORAGE, SOLVER),
    ("study/spectra.py", STORAGE, SOLVER),
    ("study/spectra.py", CHART, SOLVER),
    ("study/growth.py", GROWTH, STORAGE),
    ("study/growth.py", CHART, SOLVER),
    ("study/peaks.py", CHART, SOLVER),
    ("study/wear.py", CHART, SOLVER),
    ("blade/frequencies.py", CHART, SOLVER),
    ("extras/chart/search.py", CHART, SOLVER),
    ("extras/chart/point.py", CHART, SOLVER),
]
NUMBERLESS = ("io/", "plugins.py", "settings/")  # compute no number
CONFIG = {"study/grid.py"}
"""What makes values of the config, which are in the key."""
OF_CHART = {"study/variants.py", "study/paper.py", "study/manifest.py"}  # manifest: the name of a longer run
FILES = {
    "study/__init__.py": "",
    "study/maps.py": "import numpy\nfrom bladerub.study import grid\nfrom bladerub.io import hdf5\n",
    "study/grid.py": "def f():\n    from bladerub.study.findings.claim import Claim\n    from . import x\n",
    "study/findings/claim.py": "from bladerub.study.maps import read_map\nfrom bladerub.contact import run\n",
    "io/hdf5.py": "from bladerub.io import atomic\n",
    "io/atomic.py": "",
    "contact/run.py": "",
    "extras/a.py": "from bladerub.extras.b import x\ndef f():\n    from bladerub.extras.c import y\n",
    "extras/b.py": "",
    "extras/c.py": "from bladerub.contact import run\nfrom bladerub.io import atomic\n",
}
STUDY = ["study/__init__.py", "study/findings/claim.py", "study/grid.py", "study/maps.py"]


@pytest.fixture
def package(tmp_path, monkeypatch):
    for name, *_ in EDITS:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("a = 1\n")
    monkeypatch.setattr(sources, "PACKAGE", tmp_path)
    return tmp_path


@pytest.fixture(autouse=True)
def _no_digest_is_left():
    yield
    sources.digest_of.cache_clear()


def fresh(digest):
    sources.digest_of.cache_clear()
    return digest()


@pytest.mark.parametrize(("changed", "digest", "other"), EDITS)
def test_an_edit_changes_the_digest_it_belongs_to_alone(package, changed, digest, other):
    before = fresh(digest), fresh(other)
    (package / changed).write_text("a = 2\n")
    assert fresh(digest) != before[0]
    assert fresh(other) == before[1]


def test_a_file_that_moves_changes_the_digest(package):
    before = fresh(SOLVER)
    (package / "contact/run.py").rename(package / "contact/kernel/new.py")
    after = fresh(SOLVER)
    (package / "contact/kernel/new.py").rename(package / "contact/new.py")
    assert len({before, after, fresh(SOLVER)}) == 3


def left_out(entry, *digests):
    """Modules behind `entry`, directly or not, that none of the digests covers."""
    covered = set().union(*(fresh(digest) for digest in digests))
    behind = sources._paths_behind([entry], {path.stem for path in sources.PACKAGE.iterdir()})
    names = {path.relative_to(sources.PACKAGE).as_posix() for path in behind - covered}
    return {name for name in names if not name.startswith(NUMBERLESS)}


@pytest.mark.parametrize(
    ("entry", "digests", "expected"),
    [
        ("contact.run", (SOLVER,), set()),
        ("study.store", (SOLVER, STORAGE), CONFIG),
        ("study.growth", (SOLVER, GROWTH), set()),
        ("extras.chart.search", (SOLVER, CHART), CONFIG | OF_CHART),
    ],
)
def test_what_digests_of_results_leave_out_determines_no_number(monkeypatch, entry, digests, expected):
    monkeypatch.setattr(sources, "source_digest", set)
    assert left_out(entry, *digests) == expected


def test_imports_are_followed_within_the_subpackages_of_the_modules(tmp_path, monkeypatch):
    package = tmp_path / "src" / "bladerub"
    for name, text in FILES.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    monkeypatch.setattr(sources, "PACKAGE", package)
    monkeypatch.setattr(sources, "_path_of", sources._path_of.__wrapped__)  # without the cache
    monkeypatch.chdir(tmp_path)
    for modules, behind in (
        (["study.maps"], STUDY),
        (["study.maps", "io.hdf5"], ["io/atomic.py", "io/hdf5.py", *STUDY]),
        (["io.atomic"], ["io/atomic.py"]),
        (["extras.c"], ["contact/run.py", "extras/c.py"]),
    ):
        assert sources.files_behind(*modules) == [f"src/bladerub/{name}" for name in behind]
    assert sources.extras_behind("from bladerub.extras.a import z\n") == {"a", "b"}
