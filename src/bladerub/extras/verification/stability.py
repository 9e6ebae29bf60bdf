"""Whether the time steps of a config are stable for the blade of its results."""

import math
from collections.abc import Iterator

from bladerub.config.checks import reads
from bladerub.io.folders import study_folder
from bladerub.settings.study import Config
from bladerub.study import grid


@reads("results", "blade", "reduction", "casings", "contact", "coatings", "solver", "speeds")
def problems(config: Config) -> Iterator[str]:
    """Check central differences by the highest mode of the blade; its runs do if it is not built yet."""
    solver = config.solver
    key = next((name for name in ("max_time_step", "steps_per_element") if getattr(solver, name)), None)
    if solver.scheme != "central_differences" or key is None:  # by the tolerance they are stable
        return
    from bladerub.blade.files import is_built  # as the rest, needed for this scheme alone
    from bladerub.blade.validation import read_reduced_blade
    from bladerub.contact.modes import mode_shapes_at
    from bladerub.contact.steps import own_steps

    model = study_folder() / config.results / "blade" / "reduced_model.h5"
    try:
        if not is_built(config, model):
            return
        blade = read_reduced_blade(model)
    except OSError:  # damaged
        return
    scale = config.contact.plugged("scale", grid.UNSCALED).time
    longest = (solver.max_time_step or math.inf) * scale
    for f_omega in grid.speeds(config):
        passage = 1 / (f_omega * blade.f1_hz * config.contact.elements)
        step = passage / own_steps(passage, solver.steps_per_element or 0, longest)
        stable = 2 / mode_shapes_at(blade, f_omega)[0][-1]
        if step >= stable:
            yield (
                f"solver.{key} = {getattr(solver, key):g}: central_differences needs steps below "
                f"{stable / scale:.3g} s for the highest mode of this blade"
            )
            return
