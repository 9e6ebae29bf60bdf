from stand_in import blade  # noqa: F401 (fixture)
