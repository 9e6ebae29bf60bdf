"""An invocation of the workflow: its config and studies, what it plans again, and what it clears away."""

import itertools
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from bladerub import plugins
from bladerub.config.errors import ConfigError, Location
from bladerub.config.read import LaidOver, is_whole, read_with_notes
from bladerub.io import atomic, checksum
from bladerub.io.errors import DamagedFile, exit_on_error
from bladerub.io.folders import CONFIG, ROOT, provide_for_unknown_user
from bladerub.io.sources import extras_behind
from bladerub.settings.study import Config
from bladerub.study.manifest import ManifestRow, Row, listed_files
from bladerub.workflow.job import collect_seldom

_OF_MODULE = "config of the module"


def read_config(workflow: Any, config: Mapping[str, Any]) -> tuple[Config, list[str], LaidOver]:
    """Read the config of the study with the lines of its files, which Snakemake does not keep.

    `workflow` is that of the Snakefile, `config` as Snakemake has it before any ``configfile``: what the
    command line says, or ``config`` of the ``module`` statement of another Snakefile. That is laid over the
    config of the study here, or of the paper where there is none; files and values of the command line are
    then of the other workflow. Returns the checked config, the notes of it, and what was
    laid over the config of the study. Raises `ConfigError` as `bladerub.config.read.read`.
    """
    settings = workflow.config_settings
    base, laid_over, source = CONFIG, LaidOver([*map(str, settings.configfiles)], settings.config), "--config"
    if not isinstance(config, Mapping):
        raise ConfigError.at(Location(_OF_MODULE), "must hold keys, as config/config.yaml does")
    if config and config != settings.overwrite_config:
        base = CONFIG if CONFIG.is_file() and is_whole(CONFIG) else ROOT / CONFIG
        laid_over, source = LaidOver((), config), _OF_MODULE
    study, notes = read_with_notes(
        base,
        *laid_over.files,
        command_line=laid_over.command_line,
        source=source,
        is_checked=not workflow.is_main_process,
    )
    return study, notes, laid_over


def rules_of_studies(repository: Path) -> tuple[list[Path], list[str]]:
    """Return the rules of the studies in ``studies``, and a line for each that is left out.

    Those need, in rules, scripts or what these import, a folder of `bladerub.extras` that is not there.
    """
    present = {path.stem for path in plugins.EXTRAS.glob("*") if path.is_dir() or path.suffix == ".py"}
    complete, notes = [], []
    for rules in sorted(repository.glob("studies/*/rules.smk")):
        code = [path.read_text(encoding="utf-8") for path in (rules, *rules.parent.glob("scripts/*.py"))]
        if missing := sorted(extras_behind(*code) - present):
            needed = " and ".join(f"bladerub.extras.{name}" for name in missing)
            notes.append(f"without the study {rules.parent.name}, which needs {needed}")
        else:
            complete.append(rules)
    return complete, notes


def damage(path: str | Path, check: Callable[[str | Path], Any] = checksum.is_sealed) -> str | None:
    """Say in a line, by `check`, how a file is damaged; None if whole or absent, `OSError` if unreadable."""
    try:
        check(path)
    except FileNotFoundError:
        return None
    except DamagedFile as error:
        return str(error)
    return None


def loss(manifest: str | Path, kind: type[Row] = ManifestRow) -> str | None:
    """Say as `damage` which file of a manifest, with rows of this kind, is lost or cut short."""

    def check(manifest: str | Path) -> None:
        for file in listed_files(manifest, kind):
            if file.is_lost():
                raise DamagedFile(f"{file.path}: missing, or not as long as it was written")

    return damage(manifest, check)


def replaces(
    workflow: Any, pattern: str, problem_of: Callable[[str], str | None] = loss
) -> Callable[[Any], list[str]]:
    """Return an input function without a file, which has a job done again if its output has a problem.

    `pattern` is an output of the rule, `problem_of` is `damage`, or `loss` if it is a manifest. The job is
    planned as with ``--forcerun``, whether this is a dry run or not, and computes only what is not there.
    """

    @cache
    def plan_again(output: str) -> None:
        with exit_on_error():
            problem = problem_of(output)
        if problem:
            workflow.dag.forcefiles.add(output)
            _print(f"{problem}; its job is planned again and computes only what is not there")

    def no_files(wildcards: Any) -> list[str]:
        if workflow.is_main_process:
            plan_again(pattern.format(**wildcards))
        return []

    return no_files


def _print(line: str) -> None:
    print(f"bladerub: {line}", file=sys.stderr)


_planned: list[tuple[str, LaidOver, Callable[[], None]]] = []


def plan(
    results: str, laid_over: LaidOver, notes: Sequence[str] = (), begin: Callable[[], None] = lambda: None
) -> None:
    """Note what this invocation will `start`, with the results in this folder, and what makes them.

    Prints what is known of the results (``RECORDS``), and the `notes` on the config, a line each. `begin` is
    called at the start if jobs run on this machine.
    """
    collect_seldom()
    provide_for_unknown_user()
    for remedy in plugins.loaded("REMEDIES").values():
        remedy.begin()
    _planned[:] = [(results, laid_over, begin)]
    of_results = (record.notes(results, laid_over) for record in plugins.loaded("RECORDS").values())
    for note in itertools.chain(*of_results, notes):
        _print(note)


def start(workflow: Any) -> None:
    """Begin to compute what was planned: `prepare` its results folder.

    Called in ``onstart`` with Snakemake's ``workflow``. A Snakefile that takes in this workflow as a module
    calls it from its own, since Snakemake ignores that of a module. What plugs in may raise `BadInput`.
    """
    ((results, laid_over, begin),) = _planned
    for remedy in plugins.loaded("REMEDIES").values():
        remedy.start(workflow, [results])
    prepare(results)
    for record in plugins.loaded("RECORDS").values():
        record.start(workflow, results, laid_over)
    if workflow.local_exec:  # a job on another machine shares nothing with this process
        begin()


def stopped() -> None:
    """Say, after an error or Ctrl-C, what becomes of what was done; called as `start` is."""
    _print("what is finished is kept; the same command goes on from there")


def finished(results: str | Path) -> None:
    """Say after the last job what there is, and what to open."""
    results = Path(results)
    if n_figures := sum(path.suffix == ".png" for path in results.glob("figures/**/*")):
        figures = "1 figure" if n_figures == 1 else f"{n_figures} figures"
        tables = f", tables in {results / 'tables'}" if (results / "tables").is_dir() else ""
        _print(f"{figures} in {results / 'figures'}{tables}")
    for page in sorted(results.glob("*.html")):
        _print(f"open {page} in a browser")


def prepare(results: str | Path) -> None:
    """Delete what killed jobs were writing; raise an `OSError` if the results folder cannot be written."""
    results = Path(results)
    try:
        results.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=results):
            pass
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(results)) from error
    atomic.delete_abandoned(results)
