"""A finished study as an RO-Crate (https://w3id.org/ro/crate)."""

import json
import zipfile


def test_the_crate_holds_the_workflow_and_what_it_made(copied_study, tiny):
    copied_study.build(tiny, "crate")
    with zipfile.ZipFile(copied_study.results / "study.crate.zip") as archive:
        names, metadata = archive.namelist(), json.loads(archive.read("ro-crate-metadata.json"))
    entities = {entity["@id"]: entity for entity in metadata["@graph"]}
    workflow = entities[entities["./"]["mainEntity"]["@id"]]
    assert "ComputationalWorkflow" in workflow["@type"]
    assert entities["#provenance_software"]["value"].startswith("bladerub ")
    assert {part["@id"] for part in entities["./"]["hasPart"]} <= entities.keys()
    assert {"Snakefile", "config/config.yaml", "results/tables/findings.csv"} <= set(names)
    assert "results/maps/2nd_E2_K0.5_theta0.15.h5" in names
