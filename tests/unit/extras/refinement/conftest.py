from blade_fixtures import *  # noqa: F403 (fixtures)
