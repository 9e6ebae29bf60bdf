from study_fixtures import (  # noqa: F401 (fixtures)
    angle,
    blade,
    case,
    compute,
    config,
    growing,
    make_map,
    make_result,
    repeated,
    simulated,
    spec,
    study,
)
