from blade_parts import *  # noqa: F403 (fixtures)
