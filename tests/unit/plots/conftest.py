from plot_fixtures import coating_map, draws  # noqa: F401 (fixtures)
