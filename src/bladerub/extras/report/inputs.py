"""What a study was computed with: its quantities with units, what made its tables, and how to cite it."""

import math
from collections.abc import Iterator
from datetime import UTC, datetime

import yaml

from bladerub.config.units import pressure_in_words
from bladerub.contact.spec import Casing
from bladerub.extras.report.results import Results, files
from bladerub.extras.report.words import mm, percent, rpm
from bladerub.io.folders import ROOT
from bladerub.io.provenance import PREFIX, software
from bladerub.study.grid import modulus_unit, run_spec


def quantities(results: Results) -> Iterator[tuple[str, str]]:
    """List what the study was computed with, each with its unit."""
    config = results.config
    specs = {case.casing: run_spec(config, case, 0.0) for case in results.cases.values()}
    yield from _of_blade(results)
    yield from ((f"casing {name}", _casing(spec.casing)) for name, spec in specs.items())
    spec = next(iter(specs.values()))
    yield "coatings", f"{len(results.cases)}; E = 1 and K = 1 are {pressure_in_words(modulus_unit(config))}"
    yield (
        "layer of the coating",
        f"{mm(spec.coating.thickness)} mm, {spec.coating.n_elements} elements around",
    )
    yield "law of the coating", spec.coating.element_law.label
    leading, trailing = map(mm, spec.clearance)
    yield "clearance", f"{leading} mm at the leading edge, {trailing} mm at the trailing edge"
    yield "damping ratio", f"{percent(spec.damping_ratio)} % of every mode"
    speeds, step = results.runs.rpm, 60 * results.f1_hz * config["speeds"]["step"]
    n = len(results.runs) // len(results.cases)
    yield "speeds", f"{n}, {rpm(speeds.min())} to {rpm(speeds.max())} rpm, even steps of {step:.3g} rpm"
    longer = config["analysis"]["divergence"]["confirmation_revolutions"]
    yield "length of a run", f"{spec.revolutions} revolutions from rest, {longer} if the vibration grows"
    yield "displacement limit", f"{mm(spec.displacement_limit)} mm"
    yield "tolerance of the time step", f"{percent(spec.tolerance)} % of wear and peaks"


def _of_blade(results: Results) -> Iterator[tuple[str, str]]:
    blade = results.config["blade"]
    yield "blade", ", ".join(blade["source"]) if "source" in blade else "sections of the config"
    yield "length of the blade", f"{mm(blade['length'], 4)} mm"
    if "hub_radius" in blade:
        yield "radius of the hub", f"{mm(blade['hub_radius'], 4)} mm"
    if material := blade.get("material"):
        modulus, density = pressure_in_words(material["young_modulus"]), material["density"]
        yield "material", f"E = {modulus}, ν = {material['poisson_ratio']:g}, {density:g} kg/m³"
    yield "first frequency at rest, f₁(0)", f"{results.f1_hz:.5g} Hz"
    if nominal := results.config["figures"].get("nominal_speed"):
        yield "nominal speed", f"{rpm(nominal)} rpm"


def _casing(casing: Casing) -> str:
    terms = ", ".join(map(str, casing.nodal_diameters))
    sizes = f"amplitude {mm(casing.amplitude)} mm, interference {mm(casing.interference)} mm"
    shape = f"nodal diameters {terms}" if terms else "as measured"
    return f"{shape}, {sizes}, start at {math.degrees(casing.start_angle):.3g}°"


def origin(results: Results) -> Iterator[tuple[str, str]]:
    """List what made the tables, when the newest file was written (they hold no date), and what the page."""
    for name, value in results.origin.items():
        yield name.removeprefix(PREFIX).replace("_", " "), value
    newest = max(path.stat().st_mtime for path in files(results.config, results.folder))
    yield "newest file read", datetime.fromtimestamp(newest, UTC).strftime("%Y-%m-%d %H:%M UTC")
    yield "this page", software()


def citation() -> str:
    """Say how to cite the program and the paper, from CITATION.cff."""
    about = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    works = [about, *about["references"]]
    return (
        "; ".join(f"{_authors(work)}: {work['title']}" for work in works) + f" (version {about['version']})."
    )


def _authors(work: dict) -> str:
    return ", ".join(author.get("name") or author["family-names"] for author in work["authors"])
