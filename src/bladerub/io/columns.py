"""What the columns of the tables mean: a name means the same in every table."""

from __future__ import annotations

from typing import Any, NamedTuple

STRING, NUMBER, INTEGER = "string", "number", "integer"
BOOLEAN = {"base": "boolean", "format": "True|False"}


class Column(NamedTuple):
    """One column.

    Parameters
    ----------
    datatype : str or dict
        As in "CSV on the Web".
    unit : str or None
        SI unit, ``"1"`` for a pure or normalised number, None for text and for what another column gives the
        unit of.
    description : str
        What it is, in words.
    """

    datatype: str | dict[str, Any]
    unit: str | None
    description: str


COLUMNS = {
    # coating and speed
    "casing": Column(STRING, None, "casing of the config"),
    "E": Column(NUMBER, "1", "Young modulus of the coating over contact.modulus_unit; inf: rigid casing"),
    "K": Column(NUMBER, "1", "plastic modulus of the coating over contact.modulus_unit; inf: rigid casing"),
    "theta": Column(
        NUMBER,
        "rad",
        "angle of the coating's elements from the radial direction; by Coulomb's law the angle of "
        "friction, whose tangent is the coefficient",
    ),
    "law": Column(
        STRING, None, "of the tangential force: theta (constant direction) or coulomb (against sliding)"
    ),
    "peak_theta": Column(NUMBER, "m", "largest displacement of node 1 with a force of constant direction"),
    "peak_coulomb": Column(NUMBER, "m", "the same by Coulomb's law"),
    "difference": Column(NUMBER, "1", "peak_coulomb / peak_theta - 1"),
    "reversed_theta": Column(
        NUMBER,
        "1",
        "share of the steps in contact in which a node that touches does not slide with the rotation, with a "
        "force of constant direction",
    ),
    "reversed_coulomb": Column(NUMBER, "1", "the same by Coulomb's law"),
    "slowest_sliding": Column(
        NUMBER,
        "1",
        "lowest speed over the casing of a node that touches over that by the rotation, with a force of "
        "constant direction",
    ),
    "status_theta": Column(STRING, None, "of the run with a force of constant direction"),
    "status_coulomb": Column(STRING, None, "of the run by Coulomb's law"),
    "f_omega": Column(NUMBER, "1", "rotational frequency over the blade's first frequency at rest"),
    # blade
    "mode": Column(INTEGER, "1", "mode of vibration, counted from 1"),
    "f_fe": Column(NUMBER, "Hz", "frequency of the finite element model about its true equilibrium"),
    "f_fe_eq2": Column(NUMBER, "Hz", "frequency of the finite element model with the stiffness of eq. (2)"),
    "f_rom": Column(NUMBER, "Hz", "frequency of the reduced model"),
    "relative_error": Column(NUMBER, "1", "f_rom / f_fe - 1"),
    "f_fe_over_f1": Column(NUMBER, "1", "f_fe over the blade's first frequency at rest"),
    "f_rom_over_f1": Column(NUMBER, "1", "f_rom over the blade's first frequency at rest"),
    # response
    "order": Column(INTEGER, "1", "engine order: vibrations per revolution"),
    "f_peak": Column(NUMBER, "1", "f_omega of the greatest amplitude on the engine order"),
    "amplitude": Column(
        NUMBER,
        "m",
        "amplitude of the radial displacement of node 1 on the engine order",
    ),
    "revolution": Column(NUMBER, "1", "time in revolutions from the start of the run"),
    "radial_displacement": Column(NUMBER, "m", "radial displacement of node 1"),
    "growth_per_revolution": Column(NUMBER, "1", "relative growth of the amplitude in a revolution"),
    "growth_low": Column(NUMBER, "1", "lower end of its confidence interval"),
    "growth_high": Column(NUMBER, "1", "upper end of its confidence interval"),
    "saturating": Column(BOOLEAN, None, "whether growth ends within the longer run"),
    "divergent": Column(BOOLEAN, None, "whether growth lasts or the blade leaves all bounds"),
    "lobes": Column(INTEGER, "1", "number of worn lobes"),
    "revolutions": Column(INTEGER, "1", "length of the run that the verdict rests on"),
    "status": Column(STRING, None, "of that run: completed, or unbounded: the tip left all bounds"),
    # chart of coatings
    "Y4": Column(NUMBER, "m", "greatest amplitude on engine order 4 near its crossing with C1"),
    "f4": Column(NUMBER, "1", "f_omega of Y4"),
    "Y6": Column(NUMBER, "m", "greatest amplitude on engine order 6 near its crossing with C1"),
    "f6": Column(NUMBER, "1", "f_omega of Y6"),
    "peak": Column(NUMBER, "m", "greatest absolute radial displacement of node 1 over the speeds"),
    "f_at_peak": Column(NUMBER, "1", "f_omega of that displacement"),
    "worn_volume": Column(NUMBER, "m3", "greatest volume that a run wears off the coating"),
    "deepest_wear": Column(NUMBER, "m", "greatest worn depth under any node over the speeds"),
    "divergent_share": Column(NUMBER, "1", "share of evenly spaced speeds whose run diverges"),
    "unbounded_share": Column(NUMBER, "1", "share of them at which the tip left all bounds"),
    "runs": Column(
        INTEGER, "1", "speeds at which the coating was run; in the cost of a sample, runs made for it"
    ),
    "safe": Column(BOOLEAN, None, "whether the limits of the config are kept"),
    "E_T": Column(NUMBER, "1", "modulus of the contact while it wears, E K / (E + K)"),
    "f_crossing": Column(NUMBER, "1", "f_omega at which the engine order crosses C1, without contact"),
    "below_crossing": Column(INTEGER, "1", "coatings whose f_peak is below f_crossing, so another response"),
    **{
        f"{measure}_{modulus}": Column(NUMBER, "1", f"{meaning} {modulus}")
        for measure, meaning in {
            "rank_correlation": "rank correlation of f_peak with",
            "scatter": "root mean square distance of f_peak from the best curve that rises with",
        }.items()
        for modulus in ("E_T", "K", "E")
    },
    "modulus_ratio": Column(
        NUMBER, "1", "E_T over that of the lowest theta at the same f_peak, where stiffening is small"
    ),
    "modulus_ratio_by_share": Column(NUMBER, "1", "the same by the work of the bars on the first mode"),
    "wear_per_cycle": Column(NUMBER, "J", "energy dissipated by wear in a cycle of the vibration"),
    "sliding_per_cycle": Column(NUMBER, "J", "energy dissipated by the tangential resistance in a cycle"),
    "damping_per_cycle": Column(NUMBER, "J", "energy dissipated by modal damping in a cycle"),
    "along": Column(
        STRING, None, "modulus that the ridge is followed along; the other is that of the maximum"
    ),
    "speed_step": Column(NUMBER, "1", "step of the f_omega that were looked at"),
    "lowest_neighbour": Column(NUMBER, "m", "lowest amplitude of the cells around"),
    "highest_neighbour": Column(NUMBER, "m", "highest amplitude of the cells around"),
    "lowest_E_T": Column(NUMBER, "1", "lowest E_T on the ridge"),
    "highest_E_T": Column(NUMBER, "1", "highest E_T on the ridge"),
    "neighbour_spread": Column(NUMBER, "1", "highest less lowest neighbour over the amplitude, median"),
    "height_lost": Column(NUMBER, "1", "1 less the amplitude over that of the finest step, median"),
    "K_shift": Column(NUMBER, "1", "factor between K of the ridge and that of the finest step, median"),
    "quantity": Column(STRING, None, "column of the chart"),
    "found": Column(NUMBER, "m", "greatest value among the speeds that the search looks at"),
    "f_found": Column(NUMBER, "1", "its f_omega"),
    "greatest": Column(NUMBER, "m", "greatest value among all speeds of the study"),
    "f_greatest": Column(NUMBER, "1", "its f_omega"),
    "missed": Column(NUMBER, "1", "1 - found / greatest"),
    "coatings": Column(INTEGER, "1", "number of coatings"),
    "exact": Column(INTEGER, "1", "coatings of which the search finds the greatest value"),
    "within_1_percent": Column(INTEGER, "1", "coatings of which it misses at most 1 %"),
    "within_5_percent": Column(INTEGER, "1", "coatings of which it misses at most 5 %"),
    "worst_missed": Column(NUMBER, "1", "greatest of missed"),
    "in_chart": Column(NUMBER, "m", "the value in the chart"),
    "disagreement": Column(NUMBER, "1", "in_chart / found - 1"),
    # sweeps and long runs
    "direction": Column(STRING, None, "up: the speed rises, down: it falls"),
    "rate": Column(NUMBER, "1/s", "change of f_omega in a second"),
    "f_peak_constant": Column(NUMBER, "1", "f_peak of the runs at constant speed"),
    "amplitude_constant": Column(NUMBER, "m", "amplitude there"),
    "ratio": Column(NUMBER, "1", "amplitude over amplitude_constant"),
    "survives": Column(BOOLEAN, None, "whether the ratio is at least sweeps.survival"),
    "f_end": Column(NUMBER, "1", "f_omega at which the passage ended"),
    "max_wear": Column(NUMBER, "m", "greatest worn depth under any interface node"),
    "energy_residual": Column(NUMBER, "1", "what the energy ledger misses, over the work exchanged"),
    "why": Column(STRING, None, "why the run was made longer: it grows, or it is the peak f_k"),
    "verdict": Column(
        STRING, None, "steady, saturating, free (worn), divergent or unbounded after so many revolutions"
    ),
    "late_amplitude": Column(
        NUMBER, "m", "half the range of the radial displacement of node 1, mean over the last revolutions"
    ),
    "ms_per_revolution": Column(NUMBER, "ms", "wall time of a revolution, mean over all until then"),
    # coating and casing
    "element": Column(INTEGER, "1", "element of the coating, counted from the one under the node"),
    "position": Column(NUMBER, "m", "middle of the element along the casing, from the node"),
    "shortening": Column(NUMBER, "m", "shortening of the element under the tip"),
    "wear": Column(NUMBER, "m", "permanent shortening; around the casing, the mean over the interface nodes"),
    "stress": Column(NUMBER, "1", "stress over contact.modulus_unit"),
    "yield_stress": Column(NUMBER, "1", "elastic limit over contact.modulus_unit"),
    "strain": Column(NUMBER, "1", "compressive strain"),
    "plastic_strain": Column(NUMBER, "1", "permanent compressive strain"),
    "angle": Column(NUMBER, "rad", "casing angle"),
    "nodal_diameters": Column(STRING, None, "nodal diameters of the casing's shape, alone or combined"),
    "inward": Column(NUMBER, "m", "inward displacement of the casing's inner surface"),
    # claims
    "set": Column(STRING, None, "set of choices, a part of the config laid over the study"),
    "variation": Column(STRING, None, "part of the study, or way to look at it"),
    "id": Column(STRING, None, "claim of the paper and part of it"),
    "claim": Column(STRING, None, "the paper's statement, with its figure"),
    "paper": Column(STRING, None, "what the paper says, in the unit of the column unit"),
    "measured": Column(STRING, None, "the same of this model: a number, or words"),
    "unit": Column(STRING, None, "unit of paper, measured and margin; 1 for pure and normalised numbers"),
    "holds": Column(STRING, None, "yes, partly or no"),
    "margin": Column(
        NUMBER, None, "distance of measured from the border of yes, positive where it holds; in unit"
    ),
    # robustness
    "robustness": Column(
        NUMBER,
        "1",
        "share in which the claim holds of the samples of the last `snakemake robustness` that can tell; "
        "empty where their reference says otherwise than holds, and before any",
    ),
    "part": Column(STRING, None, "part of the design: a small study for some of the claims"),
    "sample": Column(INTEGER, "1", "sample of the design, counted from 0; -1: the study's own values"),
    "samples": Column(INTEGER, "1", "samples that can tell whether the claim holds"),
    "yes_share": Column(NUMBER, "1", "share of them in which it holds"),
    "partly_share": Column(NUMBER, "1", "share of them in which it holds partly"),
    "no_share": Column(NUMBER, "1", "share of them in which it does not hold"),
    "reference": Column(STRING, None, "holds in the same small study with the study's own values"),
    "predicted": Column(
        NUMBER,
        "1",
        "share of the variance that the expansion behind the indices predicts for samples left out of it",
    ),
    "decided_by": Column(STRING, None, "factors with a total index of the verdict from 0.1 on"),
    "runs_per_sample": Column(NUMBER, "1", "runs that a sample takes, median"),
    "cpu_s_per_sample": Column(NUMBER, "s", "processor time that a sample takes, median, without the blade"),
    "factor": Column(STRING, None, "choice that the paper leaves open"),
    "key": Column(STRING, None, "number of the config that it sets"),
    "value": Column(NUMBER, None, "its value in the sample, in the unit of the column unit"),
    "output": Column(STRING, None, "what is decided: the verdict (1, 0.5 or 0) or the rank of the margin"),
    "first": Column(
        NUMBER, "1", "first-order Sobol index: share of the variance by the factor alone, as far as predicted"
    ),
    "total": Column(NUMBER, "1", "total Sobol index: the same with all interactions of the factor"),
    # cost
    "stage": Column(STRING, None, "stage of the workflow"),
    "rule": Column(STRING, None, "rule of the workflow"),
    "job": Column(STRING, None, "what tells the jobs of the rule apart"),
    "wall_s": Column(NUMBER, "s", "time the job took"),
    "cpu_s": Column(
        NUMBER,
        "s",
        "processor time of the job and its children, or of a sample",
    ),
    "memory_mb": Column(NUMBER, "MiB", "largest memory of the job and its children"),
}
"""Every column by its name."""
