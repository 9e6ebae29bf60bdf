# Snakemake's report (`snakemake --report report.html`): what it shows, under which name, in which order.
report: "../report/workflow.rst"


CATEGORIES = {
    name: f"{number}. {name}"  # the report sorts them by name
    for number, name in enumerate(
        [
            "Model",
            "Wear and spectra",
            "Moduli of the coating",
            "Angle of the elements",
            "Claims",
            "Sweeps and long runs",
            "Cost",
            "Choice of a coating",
        ],
        1,
    )
}


def shown(path, name, category):
    """A file that the report shows; the first line of its caption is its name there."""
    caption = f"../report/{name}.rst"
    with open(workflow.source_path(caption), encoding="utf-8") as lines:
        title = next(lines).strip()
    return report(
        path,
        caption=caption,
        category=CATEGORIES[category],
        labels={"what": title, "as": path.rsplit(".", 1)[-1]},
    )
