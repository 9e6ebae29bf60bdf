from blade_fixtures import blade_config, twisted_config  # noqa: F401 (fixtures)
from stand_in import blade  # noqa: F401 (fixture)
