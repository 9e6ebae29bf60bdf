"""Every command where the terminal or the language of the system is another."""

import pytest
from commands import ON_RESULTS, OTHERS, call

LOCALES = {
    "ASCII": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "German": {"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8", "LANGUAGE": "de"},
}


@pytest.mark.parametrize("locale", ["ASCII", pytest.param("German", marks=pytest.mark.nightly)])
def test_every_command_answers_in_any_locale(copied_study, locale):
    for command in ON_RESULTS + OTHERS:
        done = call(copied_study, command, **LOCALES[locale])
        said = done.stdout + done.stderr
        assert "Traceback" not in said, (command, said)
        assert "UnicodeEncodeError" not in said, (command, said)
        assert done.returncode in (0, 1, 2), (command, said)
        is_refused = (
            "none." in command[-1] or command[1] == "compare"
        )  # by design: its tables have no numbers
        assert (done.returncode == 0) != is_refused, (command, said)
