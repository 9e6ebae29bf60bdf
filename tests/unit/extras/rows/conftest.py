from stand_in import blade, change, spec  # noqa: F401 (fixtures)
