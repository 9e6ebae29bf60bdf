"""The config of an invocation of the workflow: that of the study, and what Snakemake lays over it."""

from collections.abc import Mapping
from typing import Any

from bladerub.config.read import is_whole, read_with_notes
from bladerub.config.record import Record
from bladerub.io.folders import CONFIG, ROOT
from bladerub.settings.study import Config


def read(workflow: Any, config: Mapping[str, Any]) -> tuple[Config, list[str], Record]:
    """Read the config of the study with the lines of its files, which Snakemake does not keep.

    `workflow` is that of the Snakefile, `config` as Snakemake has it before any ``configfile``: what the
    command line says, or ``config`` of the ``module`` statement of another Snakefile. That is laid over the
    config of the study here, or of the paper where there is none; files and values of the command line are
    then of the other workflow. Returns the checked config, the lines of `bladerub.config.notes`, and what was
    laid over the config of the study. Raises `ConfigError` as `bladerub.config.read.read`.
    """
    settings = workflow.config_settings
    base, laid_over, source = CONFIG, Record(settings.configfiles, settings.config), "--config"
    if config and config != settings.overwrite_config:
        base = CONFIG if CONFIG.is_file() and is_whole(CONFIG) else ROOT / CONFIG
        laid_over, source = Record((), config), "config of the module"
    study, notes = read_with_notes(
        base,
        *laid_over.files,
        command_line=laid_over.command_line,
        source=source,
        is_checked=not workflow.is_main_process,
    )
    return study, notes, laid_over
