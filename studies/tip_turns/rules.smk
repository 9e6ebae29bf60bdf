# Figures of the study whose tip turns, which `snakemake --configfile config/tip_turns.yaml` makes. Not part of `all`.
TIP_TURNS = "results/tip_turns"  # of config/tip_turns.yaml, whose rules make it

PICTURES["tip_turns_images"] = {  # shown in pairs
    f"studies/tip_turns/images/tip_turns_{name}.png": Picture(f"{TIP_TURNS}/figures/{name}.png", 64, 2)
    for name in (
        "fig08_spectrum_soft",
        "fig09_spectrum_critical",
        "fig11_Y4",
        "fig12_f4",
        "fig13_Y6",
        "fig14_f6",
        "fig15_spectrum_theta0",
        "fig16_spectrum_theta015",
    )
}
