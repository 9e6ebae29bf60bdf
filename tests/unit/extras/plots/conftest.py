from plot_fixtures import draws  # noqa: F401 (fixture)
from stand_in import blade  # noqa: F401 (fixture)
