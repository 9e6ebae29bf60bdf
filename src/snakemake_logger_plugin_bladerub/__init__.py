"""Snakemake's messages in few lines: what is planned, each stage that is done, and errors.

A job that fails says why itself (`bladerub.workflow.job`); here is said which it was and where its log is.
The default profile names this plugin. Snakemake's own messages are those of ``--verbose`` and of dry runs.
"""

import argparse
import logging
import re
import sys
import textwrap
import time
from collections import Counter

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

LONGEST = 200
"""Characters of a line: lists of files can have thousands."""

_SHOWN = {LogEvent.JOB_ERROR, LogEvent.GROUP_ERROR, LogEvent.ERROR}
_SAID_BY_JOB = "returned non-zero exit status"
_AGAIN = "Exiting because a job execution failed", "At least one job did not complete successfully"
_INTERRUPTED = "died with <Signals.SIGINT"


class LogHandler(LogHandlerBase):
    """Writes to standard error, and in a dry run to standard output, as Snakemake does."""

    writes_to_stream = True
    writes_to_file = False
    has_filter = False  # `--quiet` acts as ever
    has_formatter = False
    needs_rulegraph = False

    def __post_init__(self) -> None:
        self._stream = sys.stdout if self.common_settings.stdout else sys.stderr
        self._shows_all = self.common_settings.verbose or self.common_settings.dryrun
        self._stages: dict[int, str] = {}  # of jobs that were begun
        self._planned: Counter[str] = Counter()
        self._done: Counter[str] = Counter()
        self._is_interrupted = False

    def emit(self, record: logging.LogRecord) -> None:
        """Print what the record comes to, if anything."""
        try:
            if self._shows_all:
                text = self._refusal(record) or self.format(record)
            elif self._is_shown(record):
                text = _failed_job(record) or self._refusal(record) or self.format(record)
            else:
                text = self._progress(record)
        except Exception:
            self.handleError(record)
            return
        for line in text.splitlines():
            is_long = len(line) > LONGEST and not self._shows_all
            print(f"{line[: LONGEST - 1]}…" if is_long else line, file=self._stream)

    def _refusal(self, record: logging.LogRecord) -> str:
        # Snakemake reads the files of --configfile before the Snakefile, and names none of them
        if getattr(record, "event", None) != LogEvent.ERROR or self._planned:
            return ""
        of_rule = re.search(r"^ *BadInput: (.+)", record.getMessage(), re.M)
        return of_rule[1] if of_rule else _refused_config()

    def _is_shown(self, record: logging.LogRecord) -> bool:
        event, message = getattr(record, "event", None), record.getMessage()
        self._is_interrupted |= _INTERRUPTED in message
        if any(text in message for text in _AGAIN) or (event == LogEvent.ERROR and _SAID_BY_JOB in message):
            return False
        if event in _SHOWN:
            return not self._is_interrupted  # Ctrl-C ends all jobs, none of them has failed
        is_end = event is None and message.startswith("Nothing to be done")
        return is_end or record.levelno >= logging.WARNING

    def _progress(self, record: logging.LogRecord) -> str:
        """Say what is planned, or that the last job of a stage is done."""
        event = getattr(record, "event", None)
        if event == LogEvent.RUN_INFO:
            for rule, count in record.stats.items():
                if rule != "total":
                    self._planned[_stage(rule)] += count
            jobs = (f"{stage} {count}" if count > 1 else stage for stage, count in self._planned.items())
            return textwrap.fill(f"{self._planned.total()} jobs: {', '.join(jobs)}", LONGEST // 2)
        if event == LogEvent.JOB_INFO:
            self._stages[record.jobid] = _stage(record.rule_name)
        elif event == LogEvent.JOB_FINISHED and (stage := self._stages.get(record.job_id)):
            self._done[stage] += 1
            if self._done[stage] >= self._planned[stage]:
                done = f"{self._done.total()} of {self._planned.total()} jobs are done"
                return f"{time.strftime('%H:%M:%S')} {stage}: {self._done[stage]}; {done}"
        return ""


def _stage(rule: str) -> str:
    return "figures" if rule.startswith("fig") else rule


def _failed_job(record: logging.LogRecord) -> str:
    """Say in a line which job failed, if one did, by the file that it did not make, and where its log is."""
    if getattr(record, "event", None) != LogEvent.JOB_ERROR or not record.log:
        return ""
    output = f" ({record.output[0]})" if record.output else ""
    return f"{record.rule_name} failed{output}; log: {', '.join(record.log)}"


def _refused_config() -> str:
    """Say which value, or file, line and column, is no config on the command line, if anything is."""
    from bladerub.config import files
    from bladerub.config.errors import ConfigError

    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--configfile", "--configfiles", nargs="+", default=[])
    parser.add_argument("--config", "-C", nargs="+", default=[])
    options, _ = parser.parse_known_args(sys.argv[1:])
    for entry in options.config:
        if not re.match(r"[a-zA-Z_][\w-]*\w=", entry):
            requirement = "must be a key at the top and its value, as in --config 'figures={dpi: 100}'"
            return f"--config {entry}: {requirement}"
    for path in options.configfile:
        try:
            files.read(path)
        except ConfigError as error:
            is_target = not path.endswith((".yaml", ".yml"))
            return f"{error}{'; targets go before --configfile' if is_target else ''}"
    return ""
