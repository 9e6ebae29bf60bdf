"""``bladerub benchmark``: how fast the time loop is on this machine."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bladerub.cli import inputs
from bladerub.extras.bounds import require
from bladerub.io.errors import BadInput
from bladerub.numerics.lanes import FEWEST_NODES, MOST_NODES

if TYPE_CHECKING:
    from bladerub.settings.study import Config

_LOOPS = {"numpy": "NumPy", "numba": "the same compiled by numba", "production": "loop of the study"}


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "benchmark",
        benchmark,
        help="measure how fast the time loop is on this machine",
        description="Integrate the same two revolutions of the study's blade from rest with a plain NumPy "
        "loop, with that loop compiled by numba, and with the loop of the study: once with contact in a "
        "third of the steps, once vibrating freely. The figures are medians of rounds, in which the loops "
        "take turns, on one core.",
        epilog="Fraction of peak: useful operations a second, over those of a loop of products and sums in "
        "vectors of the same width. With 8 nodes they are: 39 per mode in a single step (recurrence, damping "
        "loss, displacement of the tip); 61 per mode in one application of the free-flight propagator, for "
        "any number of steps (the same over these steps, mean displacement and its bound). A step with "
        "contact adds 32 per mode (forces on the modes), one response of the 16 displacements to the 16 "
        "forces, 69 per abradable element under the tip (force once, wear and its energy) and 60 per node. "
        "Not counted are comparisons, repeated iterations for the forces and padding of vectors. "
        "Seconds a run: runs drawn from the study, set up, integrated and stored. Minutes of the study: all "
        "its runs, those that are repeated for longer, and the members of its ensembles, estimated from the "
        "drawn runs; not the blade, tables and figures.",
    )
    inputs.add_trust_to(parser)
    parser.option("--rounds", "how often to measure (default 5)", int, default=5, metavar="N")
    text = "cores for the estimate of the study (default: all there are)"
    parser.option("--cores", text, int, metavar="C")
    text = "also the cost of so many interface nodes, over that of 8; builds a blade for each"
    parser.option("--nodes", text, int, nargs="+", default=[], metavar="N")
    text = "also the cost of a run with the stress of the blade, over that of the run alone"
    parser.add_argument("--stress", action="store_true", help=text)
    text = "instead: the study's runs on the GPU and so many of them here, how fast and how different"
    parser.option("--gpu", text, int, metavar="N")
    text = "also put the figures of this machine into the table FILE, in the place of its old ones"
    parser.option("--table", text, Path, metavar="FILE")


def benchmark(options: argparse.Namespace) -> None:
    """Measure, and print the figures."""
    from bladerub.settings.coatings import RigidCoating

    config, on_gpu = inputs.read_config(options), options.gpu is not None
    require(options, rounds=(1, 1000), cores=(1, 1_000_000), gpu=(1, 1_000_000))
    if all(isinstance(entry, RigidCoating) for entry in config.coatings):
        raise BadInput("coatings: must have an abradable one, as contact with it is what is measured")
    for n in options.nodes:
        if not FEWEST_NODES <= n <= MOST_NODES:
            raise BadInput(f"--nodes {n}: must be from {FEWEST_NODES} to {MOST_NODES}")
    if options.nodes and (source := config.blade.plugged("source")) and source.plugged("matrices"):
        raise BadInput("--nodes: a blade of matrices has the interface nodes that its folder marks")
    if on_gpu and (options.nodes or options.stress):
        raise BadInput("--gpu: goes with neither --nodes nor --stress")
    if config.contact.tip_turns and not on_gpu:
        raise BadInput("contact.tip_turns = true: must be false, as the plain loop has no profile that turns")

    from bladerub.extras.benchmark import record

    if options.table:  # another table is refused before anything takes time
        record.recorded(options.table, record.GPU_COLUMNS if on_gpu else record.COLUMNS)
        inputs.require_writable("--table", options.table)
    figures, config = (_on_gpu if on_gpu else _on_processor)(options, config)
    if options.table:
        from bladerub.io.provenance import provenance

        rows, key = (record.gpu_row, ["gpu"]) if on_gpu else (record.rows, record.MACHINE)
        record.replace(options.table, rows(figures), key, provenance(config.plain()))
    inputs.show(options, figures, _of_gpu_in_words if on_gpu else _in_words)


def _on_processor(options: argparse.Namespace, config: "Config") -> "tuple[dict[str, Any], Config]":
    stored_blade, config = inputs.read_blade(options, config)

    from bladerub.extras.benchmark import estimate, measure

    blade = stored_blade.reduced
    figures = measure.benchmark(blade, config, options.rounds, options.cores, _report_stage)
    if options.nodes:
        _report_stage("building blades with more interface nodes")
        figures["cost_by_nodes"] = measure.cost_by_nodes(config, options.nodes, options.rounds)
    if options.stress:
        _report_stage("timing runs with the stress of the blade")
        with inputs.refused(OSError, BadInput, because="--stress: "):
            mesh = stored_blade.mesh_path
            figures["cost_of_stress"] = estimate.cost_of_stress(mesh, blade, config, options.rounds)
    return figures, config


def _on_gpu(options: argparse.Namespace, config: "Config") -> "tuple[dict[str, Any], Config]":
    from bladerub.extras.benchmark import gpu
    from bladerub.extras.gpu import device

    with inputs.refused(BadInput):
        name = device.describe()
    blade, config = inputs.read_blade(options, config)
    figures = gpu.compare(blade.reduced, config, device.run, options.gpu, _report_stage)
    return {"gpu": name, **figures}, config


def _of_gpu_in_words(figures: dict[str, Any]) -> str:
    compared, ratio = figures["compared_runs"], figures["seconds_per_run"] * figures["gpu_runs"]
    return "\n".join(
        [
            f"{figures['gpu']}: {figures['gpu_runs']} runs in {figures['kernel_s']:.3g} s, "
            f"{figures['gpu_steps_per_second'] / 1e9:.3g} billion steps a second; "
            f"{figures['gpu_s']:.3g} s with what the host does",
            f"{figures['processor']}: {figures['seconds_per_run']:.3g} s a run and core, "
            f"{ratio / figures['kernel_s']:.3g} times as long",
            f"of {compared} runs on both {figures['same_status']} have the same status, "
            f"{figures['same_steps']} the same steps, {figures['same_contact_steps']} as many with contact",
            "largest difference of the displacement in a revolution, relative: "
            f"median {figures['peak_error_median']:.1e}, 95 % of runs {figures['peak_error_p95']:.1e}, "
            f"99 % {figures['peak_error_p99']:.1e}, all {figures['peak_error_largest']:.1e}",
        ]
    )


def _report_stage(stage: str) -> None:
    print(f"bladerub benchmark: {stage}", file=sys.stderr)


def _in_words(figures: dict[str, Any]) -> str:
    rates, kinds = figures["steps_per_second"], ("contact", "free")
    rows = [("million steps a second", *kinds)]
    rows += [(words, *(f"{rates[loop][kind] / 1e6:.3g}" for kind in kinds)) for loop, words in _LOOPS.items()]
    for loop, words in (("numpy", "NumPy"), ("numba", "numba")):
        ratios = (figures[f"ratio_to_{loop}{end}"] for end in ("", "_free"))
        rows.append((f"times {words}", *(f"{ratio:.3g}" for ratio in ratios)))
    rows.append(("fraction of peak", *(f"{figures[f'fraction_of_peak_{kind}']:.2f}" for kind in kinds)))
    lines = [
        f"{figures['processor']}, vectors of {figures['vector_bits']} bits",
        f"{figures['modes']} modes, contact in {figures['contact_share']:.0%} of the steps or none, "
        f"medians of {figures['rounds']} rounds",
        "",
        *(inputs.row(30, *row) for row in rows),
        "",
        f"peak: {figures['peak_flops'] / 1e9:.3g} billion operations a second",
        f"a run of the study: {figures['seconds_per_run']:.3g} s; {figures['runs']} runs and "
        f"{figures['members']} members of ensembles on {figures['cores']} cores: "
        f"{figures['study_minutes']:.3g} minutes",
    ]
    for n, cost in figures.get("cost_by_nodes", {}).items():
        lines.append(f"{n} interface nodes: {cost:.3g} times the time of 8")
    if "cost_of_stress" in figures:
        lines.append(f"a run with the stress of the blade: {figures['cost_of_stress']:.3g} times a run alone")
    return "\n".join(lines)
