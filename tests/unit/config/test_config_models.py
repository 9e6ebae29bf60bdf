import pytest

from bladerub import plugins
from bladerub.config.keys import NUMBERS, key_of
from bladerub.config.problems import problems
from bladerub.config.read import load
from bladerub.io.folders import PACKAGE, ROOT
from bladerub.settings.fields import Section
from bladerub.settings.study import defaults, required, whole

STUDY = load(ROOT / "config" / "config.yaml")


def all_keys(key, path="", is_said=True):
    """Yield the path of each key, itself, and whether something is said of it."""
    yield path, key, is_said
    for name, inner in key.fields().items():
        yield from all_keys(inner, f"{path}.{name}" if path else name, bool(inner.description))
    if key.entry:
        yield from all_keys(key.entry, f"{path}[]")


KEYS = list(all_keys(key_of(whole())))
BY_PATH = {path: key for path, key, _ in KEYS}


def test_every_number_has_bounds_and_every_key_of_a_group_says_what_it_is():
    for path, key, is_said in KEYS:
        assert is_said, path
        assert key.kind not in NUMBERS or None not in key.ends, path


def test_what_limits_a_number_is_a_number_or_a_group_of_the_config():
    limits = [limit for key in BY_PATH.values() for limit in key.limits]
    assert limits
    for limit in limits:
        value = STUDY
        for name in limit.key.split("."):
            value = value[name]
        assert isinstance(value, int | float), limit
    assert {key.one_of for key in BY_PATH.values() if key.one_of} <= STUDY.keys()


class Profile(Section):
    """A source of blades."""

    digits: str


@pytest.mark.parametrize("others", [{}, {"blade.source": Profile}])
def test_a_key_plugs_in_below_a_section_that_plugs_in_or_is_not_there(monkeypatch, others):
    monkeypatch.setattr(plugins, "loaded", lambda kind: {"blade.source.profile": Profile} | others)
    source = key_of(whole.__wrapped__()).fields()["blade"].fields()["source"]
    assert source.fields().keys() == {"profile", *(["digits"] if others else [])}
    assert source.fields()["profile"].fields().keys() == {"digits"}


@pytest.mark.parametrize("value", [True, None, "0.2", [0.2], float("nan"), float("-inf"), 10**400])
def test_only_finite_numbers_are_numbers(value):
    class Mine(Section):
        """A section."""

        length: float

    assert list(problems({"length": 2}, Mine)) == []
    (line,) = problems({"length": value}, Mine)
    assert line.startswith("length = ")


def test_defaults_are_of_keys_that_may_be_left_out():
    assert defaults().keys() <= STUDY.keys()
    assert not defaults().keys() & required()


@pytest.mark.extras
def test_settings_of_extras_are_named_by_their_plugins():
    """A `settings.py` that nothing names would check nothing."""
    settings = {path.parent.name for path in (PACKAGE / "extras").glob("*/settings.py")}
    plugged = (PACKAGE / "extras").glob("*/plugin.py")
    named = {path.parent.name for path in plugged if ".settings:" in path.read_text()}
    assert settings == named
