import pytest

from bladerub.extras.chart import column
from bladerub.extras.gpu import solver
from bladerub.io import sources

CHARTING = [
    "blade/frequencies.py",
    "study/peaks.py",
    "study/wear.py",
    "extras/chart/grid.py",
    "extras/chart/search.py",
    "extras/chart/point.py",
]


@pytest.fixture
def package(tmp_path, monkeypatch):
    for folder in ("contact/kernel", "extras/gpu", "blade", "study", "extras/chart"):
        (tmp_path / folder).mkdir(parents=True)
    for name in (
        "contact/run.py",
        "contact/kernel/run.py",
        "extras/gpu/loop.cu",
        "blade/model.py",
        "study/store.py",
        "study/spectra.py",
        "study/growth.py",
        *CHARTING,
    ):
        (tmp_path / name).write_text("a = 1\n")
    monkeypatch.setattr(sources, "PACKAGE", tmp_path)
    return tmp_path


SOLVER, STORAGE = sources.solver_digest.__wrapped__, sources.storage_digest.__wrapped__


GROWTH = sources.growth_digest.__wrapped__


CHART = column.chart_digest.__wrapped__


GPU = solver.gpu_digest.__wrapped__


@pytest.mark.parametrize(
    ("changed", "digest", "other"),
    [
        ("contact/run.py", SOLVER, STORAGE),
        ("contact/new.py", SOLVER, STORAGE),
        ("blade/model.py", SOLVER, STORAGE),
        ("blade/model.py", SOLVER, GPU),
        ("extras/gpu/loop.cu", GPU, SOLVER),
        ("extras/gpu/new.py", GPU, SOLVER),
        ("study/store.py", STORAGE, SOLVER),
        ("study/spectra.py", STORAGE, SOLVER),
        ("study/growth.py", GROWTH, STORAGE),
        ("study/growth.py", GROWTH, SOLVER),
        ("study/growth.py", CHART, SOLVER),
        ("study/spectra.py", CHART, SOLVER),
        *((name, CHART, SOLVER) for name in CHARTING),
    ],
)
def test_an_edit_changes_the_digest_it_belongs_to_alone(package, changed, digest, other):
    before = digest(), other()
    (package / changed).write_text("a = 2\n")
    assert digest() != before[0]
    assert other() == before[1]


def test_a_file_that_moves_changes_the_digest(package):
    before = SOLVER()
    (package / "contact/run.py").rename(package / "contact/kernel/new.py")
    after = SOLVER()
    (package / "contact/kernel/new.py").rename(package / "contact/new.py")
    assert len({before, after, SOLVER()}) == 3


class TestCoverage:
    """What the digests of results leave out determines no number, for the reason that is given here."""

    @pytest.fixture
    def left_out(self, monkeypatch):
        """Modules behind `entry`, directly or not, that none of the digests covers."""
        monkeypatch.setattr(sources, "source_digest", set)

        def of(entry, *digests):
            covered = set().union(*(digest() for digest in digests))
            found, waiting = set(), [entry]
            while waiting:
                path = sources._path_of(waiting.pop())
                if path not in found:
                    found.add(path)
                    waiting += sources._imports(path)
            names = {path.relative_to(sources.PACKAGE).as_posix() for path in found - covered}
            return {name for name in names if not name.startswith("io/")}  # moves numbers, computes none

        return of

    def test_of_the_solver(self, left_out):
        assert left_out("contact.run", SOLVER) == set()

    def test_of_the_files_of_runs(self, left_out):
        # the values that the grid makes of the config are in the key
        config = {"study/grid.py", "study/casings.py"}
        assert left_out("study.store", SOLVER, STORAGE) == config

    def test_of_the_decision_which_runs_are_repeated(self, left_out):
        assert left_out("study.growth", SOLVER, GROWTH) == set()

    def test_of_the_points_of_the_chart(self, left_out):
        # values and orders of the config are in the key
        config = {"study/grid.py", "study/casings.py", "study/orders.py", "study/paper.py"}
        found = left_out("extras.chart.search", SOLVER, CHART)
        assert found == config | {"study/manifest.py"}  # the name of a longer run


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
def with_rules(tmp_path, monkeypatch):
    with_rules = tmp_path / "src" / "bladerub"
    for name, text in FILES.items():
        (with_rules / name).parent.mkdir(parents=True, exist_ok=True)
        (with_rules / name).write_text(text)
    monkeypatch.setattr(sources, "PACKAGE", with_rules)
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
def test_imports_are_followed_within_the_subpackages_of_the_modules(with_rules, modules, behind):
    assert sources.files_behind(*modules) == [f"src/bladerub/{name}" for name in behind]
