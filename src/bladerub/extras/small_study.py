"""A small study beside the main one, from the runs to the findings, by the same functions."""

from collections.abc import Callable, Collection
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.blade.validation import read_reduced_blade
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.study import divergence, findings, peaks
from bladerub.study.cache import blade_digest
from bladerub.study.findings.claim import claim_of
from bladerub.study.findings.evidence import Evidence, read_rom_accuracy
from bladerub.study.grid import CoatingCase, coating_cases, speeds
from bladerub.study.job import compute_all, compute_missing
from bladerub.study.manifest import write_manifest
from bladerub.study.maps import CoatingMap, collect, collect_listed, read_map, write_map
from bladerub.study.plan import coating_plan
from bladerub.study.solver import each_done, solver_of


class SmallStudy(NamedTuple):
    """What a small study shows."""

    peaks: pd.DataFrame  # as ``peaks.csv``
    divergence: pd.DataFrame  # as ``divergence.csv``
    findings: pd.DataFrame  # as of `bladerub.study.findings.judge`
    n_runs: int  # longer ones for confirmation included
    evidence: Evidence  # what the findings were measured on


def conduct(
    config: Config,
    model: str | Path,
    rom_accuracy: str | Path,
    folder: str | Path | None = None,
    claims: Collection[str] | None = None,
    report: Callable[[object], None] = lambda line: None,
) -> SmallStudy:
    """Run every coating of `config`, and judge the `claims` of the paper (default: all; ``C2``: its parts).

    `model` and `rom_accuracy` are files of its blade. Current runs in `folder` are kept; without it runs
    and maps are in memory alone.
    """
    blade, cases = read_reduced_blade(model), coating_cases(config)
    digest = blade_digest(model)
    mapped = partial(map_coating, config, blade=blade, digest=digest, folder=folder, report=report)
    # each coating of a small study has few runs
    results = dict(each_done(mapped, cases, len(cases) if solver_of(config).wants_many else 1))
    maps, n_runs = [results[case][0] for case in cases], sum(n for _, n in results.values())
    tables = {"peaks": peaks.table(config, maps), "divergence": divergence.table(config, maps)}
    evidence = Evidence(config, tables | {"rom_accuracy": read_rom_accuracy(rom_accuracy)}, maps)
    parts = [part for part in findings.CLAIMS if claims is None or claim_of(part.id) in claims]
    return SmallStudy(**tables, findings=findings.judge(evidence, parts), n_runs=n_runs, evidence=evidence)


def map_coating(
    config: Config,
    case: CoatingCase,
    blade: ReducedBlade,
    digest: str,
    folder: str | Path | None,
    report: Callable[[object], None] = lambda line: None,
) -> tuple[CoatingMap, int]:
    """Run one coating and make its map, in files of `folder`, if any; return it and the number of runs."""
    plan = coating_plan(config, case)
    if folder is None:
        stored, longer = compute_all(config, plan, blade, report=report)
        collected = collect(config, case, blade, speeds(config), stored, longer)
        return replace(collected, wear_node=None), len(stored) + sum(run is not None for run in longer)
    runs, path = Path(folder) / "runs" / case.name, Path(folder) / "maps" / f"{case.name}.h5"
    rows = compute_missing(config, plan, blade, runs, digest, report)
    write_map(path, collect_listed(config, case, blade, runs, rows), provenance(config.plain()))
    write_manifest(runs / "manifest.tsv", rows)
    return read_map(path), len(rows) + sum(bool(row.confirmation_key) for row in rows)
