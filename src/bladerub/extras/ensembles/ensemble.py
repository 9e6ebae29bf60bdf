"""Ensembles: runs of the study repeated from starts that differ by a fraction of a micrometre.

1. A chaotic run amplifies the difference of its start until nothing but the statistics is left of it: such a
   run is one draw. The members of an ensemble are further draws. A run that is not chaotic gives members that
   agree.
2. A member starts at rest with a radial displacement of node 1, in the first mode, that is drawn evenly from
   ± ``ensemble.displacement``. The draws of a run depend on ``ensemble.seed``, the coating and the speed, and
   on nothing else: more members leave those that are there as they are.
3. The runs with an ensemble are those that tables and claims rest on
   (`bladerub.extras.study_runs.chosen`).
4. Each of them is repeated from its own start with a quarter of the tolerance, which is half the step
   (`bladerub.contact.steps`): what changes is three quarters of the error that the step of the run makes.
5. Members are stored, found again and followed further when they grow as the runs of the study are
   (`bladerub.study.job`), in the folder ``ensemble`` next to them. Those that only claims on worn lobes rest
   on are not followed: lobes are counted after the revolutions of the study.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from zlib import crc32

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.spec import RunSpec
from bladerub.extras.ensembles.settings import Ensemble as Settings
from bladerub.extras.study_runs import chosen, judged, on_lobes, with_history
from bladerub.io import hdf5
from bladerub.io.errors import BadInput, DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.io.values import Comparable
from bladerub.settings.study import Config
from bladerub.study import maps
from bladerub.study.grid import SAME_SPEED, CoatingCase, run_spec, speed_name, speeds
from bladerub.study.job import RunDone, compute_missing
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import peak_orders
from bladerub.study.plan import CoatingPlan, planned_run
from bladerub.study.solver import row_of

FOLDER = "ensemble"
"""Folder of the members in that of the coating's runs, with a manifest of its own."""


@dataclass(frozen=True, eq=False)
class Ensemble(Comparable):
    """The ensembles of one coating."""

    start: np.ndarray  # (m, n), radial displacement of node 1 at the start of m members at n speeds, m
    members: tuple[CoatingMap, ...]  # m maps of the n speeds, ascending; without ``wear_node``
    refined: CoatingMap  # the runs of the study at these speeds with a quarter of the tolerance

    def places(self, coating: CoatingMap) -> np.ndarray:
        """Return the places (n,) of the ensembles among the speeds of `coating`, the map of the study."""
        return np.searchsorted(coating.f_omega, self.members[0].f_omega - SAME_SPEED)

    def draw(self, coating: CoatingMap, drawn: CoatingMap) -> CoatingMap:
        """Return `coating` with the runs `drawn`, of a member or refined, in place of its own."""
        places, values = self.places(coating), {}
        for name in OVER_SPEED:
            study_values, member_values = _equally_long(getattr(coating, name), getattr(drawn, name))
            values[name] = study_values.copy()
            values[name][places] = member_values
        return replace(coating, wear_node=None, **values)


OVER_SPEED = tuple(
    name
    for name, (dims, *_) in maps.DATASETS.items()
    if dims[0] == "f_omega" and name not in {"f_omega", "C1", "wear_node"}
)
"""Datasets of a map that differ between members."""

SHARED = tuple(name for name in maps.DATASETS if name not in (*OVER_SPEED, "wear_node"))
"""Datasets that are the same of all."""

REFINED = 2
"""Steps of a refined run over those of a run of the study, and so the members that it costs as much as."""

_REFINED = "refined_"
_FINER = "with a quarter of the tolerance of the step"


def starts(settings: Settings, case: CoatingCase, f_omega: float, members: int) -> np.ndarray:
    """Draw the starts (members,) of one run, m; `settings` are ``config.ensemble``."""
    entropy = [settings.seed, crc32(f"{case.name}/{speed_name(f_omega)}".encode())]
    limit = settings.displacement
    return np.random.default_rng(entropy).uniform(-limit, limit, members)


def expected_cost(config: Config, case: CoatingCase) -> int:
    """Count the members of a coating before its peaks are known, as if no two were next to each other."""
    if not config.ensemble.members:
        return 0
    f_omega = np.array(speeds(config))
    by_name = int((with_history(config, case, f_omega) | on_lobes(case, f_omega)).sum())
    return (config.ensemble.members + REFINED) * (by_name + 3 * len(peak_orders(config, case.casing)))


def refined(spec: RunSpec) -> RunSpec:
    """Return the run with a quarter of its tolerance, and half of the steps that it would have by itself."""
    steps, longest = 2 * spec.steps_per_element, spec.max_time_step / 2
    return replace(spec, tolerance=spec.tolerance / 4, steps_per_element=steps, max_time_step=longest)


def plan(config: Config, coating: CoatingMap) -> list[CoatingPlan]:
    """Plan the members of one coating, of the map `coating`, then the refined runs: the runs of each."""
    settings, row, case, runs = config.ensemble, row_of(config), coating.case, []
    followed = set(judged(config, coating).tolist())
    for f in chosen(config, coating).tolist():
        spec, drawn = run_spec(config, case, f), starts(settings, case, f, settings.members)
        specs = {n: replace(spec, initial_displacement=start) for n, start in enumerate(drawn.tolist(), 1)}
        specs["refined"] = refined(spec)
        runs.append(
            [
                planned_run(config, run, f"{speed_name(f)}_{name}.h5", False, row, follow=f in followed)
                for name, run in specs.items()
            ]
        )
    return [CoatingPlan(case, member) for member in zip(*runs, strict=True)]


def make(
    config: Config,
    coating: CoatingMap,
    blade: ReducedBlade,
    blade_digest: str,
    runs_folder: str | Path,
    path: str | Path,
    report: Callable[[RunDone | str], None],
    threads: int = 1,
) -> list[ManifestRow]:
    """Compute what is missing of the members of a coating, by `compute_missing`; collect all in `path`."""
    if not config.ensemble.members:
        raise BadInput("ensemble.members = 0: must be at least 1, or there is no ensemble to make")
    folder, planned = Path(runs_folder) / FOLDER, plan(config, coating)
    together = CoatingPlan(coating.case, tuple(run for member in planned for run in member.runs))
    rows = compute_missing(config, together, blade, folder, blade_digest, report, threads)
    write_manifest(folder / "manifest.tsv", rows)
    remaining_rows = iter(rows)
    *members, refined_runs = [
        maps.collect_listed(config, coating.case, blade, folder, [next(remaining_rows) for _ in member.runs])
        for member in planned
    ]
    start = [[run.spec.initial_displacement for run in member.runs] for member in planned[:-1]]
    write(path, Ensemble(np.array(start), tuple(members), refined_runs), provenance(config.plain()))
    return rows


def write(path: str | Path, ensemble: Ensemble, origin: Mapping[str, str]) -> None:
    """Write the ensembles of a coating to the file `path`; `origin` is its provenance."""
    first = ensemble.members[0]
    described = maps.variables(first)
    variables = {name: described[name] for name in SHARED}
    start = "radial displacement of node 1 at the start"
    variables["start"] = Variable(("member", "f_omega"), ensemble.start, "m", start)
    for name in OVER_SPEED:
        dims, unit, long_name = maps.DATASETS[name]
        values = _equally_long(*(getattr(runs, name) for runs in (*ensemble.members, ensemble.refined)))
        variables[name] = Variable(("member", *dims), np.stack(values[:-1]), unit, long_name)
        variables[_REFINED + name] = Variable(dims, values[-1], unit, f"{long_name}, {_FINER}")
    variables |= maps.revolutions(variables)
    member = "member, counted from 1 as its runs are"
    variables["member"] = hdf5.numbers("member", len(ensemble.members), member)
    hdf5.write(path, variables, {**vars(first.case)}, origin)


def read(path: str | Path) -> Ensemble:
    """Read what `write` has written; raises `OSError`, naming the file, if it is missing or damaged."""
    data, attributes = hdf5.read(path)
    try:
        shared = {name: data[name] for name in SHARED}
        case, start = CoatingCase.described(attributes), data["start"]
        of_members = [{name: data[name][member] for name in OVER_SPEED} for member in range(len(start))]
        of_refined = {name: data[_REFINED + name] for name in OVER_SPEED}
    except KeyError as error:
        raise DamagedFile(f"{path}: no ensembles, {error} is missing") from error
    runs = [CoatingMap(case=case, wear_node=None, **shared, **values) for values in (*of_members, of_refined)]
    return Ensemble(start, tuple(runs[:-1]), runs[-1])


def _equally_long(*arrays: np.ndarray) -> list[np.ndarray]:
    """Fill arrays (n, r) with NaN up to the largest r, for members of which none needed a longer run."""
    if arrays[0].ndim == 1:
        return list(arrays)
    width = max(array.shape[1] for array in arrays)
    return [np.pad(array, ((0, 0), (0, width - array.shape[1])), constant_values=np.nan) for array in arrays]
