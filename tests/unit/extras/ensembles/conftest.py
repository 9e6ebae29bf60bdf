from plot_fixtures import draws  # noqa: F401 (fixtures)
