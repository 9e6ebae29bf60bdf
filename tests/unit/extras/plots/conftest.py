from plot_fixtures import coating_map, draws  # noqa: F401 (fixtures)
from stand_in import blade  # noqa: F401 (fixture)
