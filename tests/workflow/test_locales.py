"""Every command where the terminal or the language of the system is another."""

import pytest
from commands import ON_RESULTS, OTHERS, call

LOCALES = {
    "ASCII": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "German": {"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8", "LANGUAGE": "de"},
}
FEW = [command for command in ON_RESULTS + OTHERS if command[1] in ("status", "run", "config")]


@pytest.mark.parametrize(
    ("locale", "commands"),
    [
        ("ASCII", FEW),
        *(pytest.param(name, ON_RESULTS + OTHERS, marks=pytest.mark.nightly) for name in LOCALES),
    ],
)
def test_commands_answer_in_any_locale(copied_study, locale, commands):
    for command in commands:
        done = call(copied_study, command, **LOCALES[locale])
        said = done.stdout + done.stderr
        assert "Traceback" not in said, (command, said)
        assert "UnicodeEncodeError" not in said, (command, said)
        is_refused = "none." in command[-1] or command[1] == "compare"  # by design: it has no numbers
        assert (done.returncode == 0) != is_refused, (command, said)
