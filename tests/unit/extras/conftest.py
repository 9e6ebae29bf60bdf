from command_fixtures import *  # noqa: F403 (fixtures)
from study_fixtures import *  # noqa: F403 (fixtures)
