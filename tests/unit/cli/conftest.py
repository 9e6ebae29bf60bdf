from command_fixtures import *  # noqa: F403 (fixtures)
