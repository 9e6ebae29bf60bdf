import pytest
from study_fixtures import CONFIG

from bladerub.config.errors import ConfigError
from bladerub.config.read import validate

config = pytest.fixture(lambda: CONFIG.plain(), name="config")


@pytest.fixture
def problems():
    """Read or validate a config: its problems, none if it is valid."""

    def of(*arguments, by=validate, **keywords):
        try:
            by(*arguments, **keywords)
        except ConfigError as error:
            return error.problems
        return []

    return of
