"""Pages quote the values and verdicts of the tables in docs/data."""

import re
import shutil
from copy import copy
from pathlib import Path

import pandas as pd
import pytest

from bladerub.io import tables
from bladerub.workflow import pages

ROOT = Path(__file__).parents[3]
SNAPSHOTS = ROOT / "docs" / "data"


def stale_places(folder):
    return differences(pages.read_tables(folder))


def differences(data, table=""):
    """What is stale among the quotes that name `table`."""
    return [
        difference
        for page in pages.pages_of(ROOT)
        for difference in pages.differences(
            quotes_of(table, page.read_text(encoding="utf-8")), str(page.relative_to(ROOT)), data
        )
    ]


def quotes_of(table, text):
    """`text`, in which what other tables say is plain text: evaluating all of it takes seconds."""
    quote = re.compile(r"<!-- = (.+?) -->(.*?)<!-- / -->", re.DOTALL)
    return quote.sub(lambda found: found[0] if table in found[1] else found[2], text)


@pytest.fixture(scope="module")
def snapshots():
    return pages.read_tables(SNAPSHOTS)


def places_after_change(data, table, key, column, value):
    changed = copy(data[table])
    chosen = (changed.rows[list(key)] == pd.Series(key)).all(axis="columns")
    assert chosen.sum() == 1
    changed.rows = changed.rows.copy()
    changed.rows.loc[chosen, column] = value
    return sorted(set(map(place, differences(data | {table: changed}, table))))


def changed_snapshots(folder, old, new):
    shutil.copytree(SNAPSHOTS, folder)
    table = folder / "findings.csv"
    text = table.read_text(encoding="utf-8")
    assert text.count(old) == 1
    table.write_text(text.replace(old, new), encoding="utf-8")
    return folder


def places_with(mark):
    return [
        f"{page.relative_to(ROOT)}:{number}"
        for page in pages.pages_of(ROOT)
        for number, line in enumerate(page.read_text(encoding="utf-8").split("\n"), 1)
        if mark in line
    ]


def lines_of(mark):
    """The lines that hold each number of such a mark: its own, or those of the table that it writes."""
    found = []
    for page in pages.pages_of(ROOT):
        lines = page.read_text(encoding="utf-8").split("\n")
        for at in (at for at, line in enumerate(lines) if mark in line):
            table = lines[at].startswith("<!-- = ")
            end = lines.index("<!-- / -->", at) if table else at
            found.append([f"{page.relative_to(ROOT)}:{number + 1}" for number in range(at, end + 1)])
    return found


def place(difference):
    return ":".join(difference.split(":")[:2])


def test_pages_are_as_their_tables():
    assert stale_places(SNAPSHOTS) == []


def test_a_changed_value_names_the_lines_that_quote_it(tmp_path):
    folder = changed_snapshots(tmp_path / "data", "0.3856962183", "0.4156962183")
    stale = stale_places(folder)
    assert [place(one) for one in stale] == places_with("findings('C1a')")
    assert {page.split(":")[0] for page in map(place, stale)} == {
        "README.md",
        "docs/explanation/blade.md",
        "docs/explanation/paper_vs_ours.md",
        "docs/explanation/validation.md",
    }
    assert all("0.42" in one for one in stale)


FOUR_BLADES = {"E": 1.1, "f_omega": 0.346, "blades": 4}
FOUR_BLADES |= {"length_scatter": 5e-5, "frequency_scatter": 0.005, "coupling": 0}
CHANGES = [
    ("rom_accuracy", {"f_omega": 0.35, "mode": 2}, "f_fe_eq2", 1.0, "rom_accuracy(0.35,2)"),
    ("campbell", {"f_omega": 0.4, "mode": 1}, "f_fe", 1.0, "campbell(0.4"),
    ("margins", {"variation": "speed step 0.004", "id": "C6a"}, "holds", "?", "0.004','C6a'"),
    (
        "friction",
        {"E": 20, "theta": 0.15, "f_omega": 0.3},
        "slowest_sliding",
        0.1,
        "column('slowest_sliding',theta=0.15)",
    ),
    (
        "sweeps",
        {"E": 0.11, "direction": "up", "rate": 0.01, "order": 4},
        "ratio",
        9.0,
        "sweeps('2nd',0.11,0.5,0,'up',0.01,4).ratio",
    ),
    ("peaks", {"E": 0.11, "K": 0.05, "order": 4}, "amplitude", 0.1, "peaks('2nd',0.11,0.05,0,4)"),
    ("findings", {"id": "C8b"}, "measured", "0.5", "findings('C8b').measured"),
    (
        "divergence",
        {
            "casing": "2nd",
            "E": 2,
            "K": 0.5,
            "theta": 0,
            "law": "theta",
            "revolutions": 20,
            "divergent": False,
            "saturating": False,
        },
        "runs",
        100000,
        "format(divergence.column('runs')",
    ),
    (
        "accuracy",
        {"drawn_from": "all", "E": 1.1, "K": 1.0, "f_omega": 0.228},
        "drawn_from",
        "important",
        "accuracy.count(drawn_from='all')",
    ),
    (
        "benchmark",
        {"processor": "AMD EPYC", "motion": "free"},
        "ratio_to_numpy",
        1.0,
        "benchmark.rows.assign",
    ),
    ("fine_margins", {"id": "C8a"}, "holds", "?", "fine_margins('study','C8a').holds"),
    ("longer_findings", {"id": "C10a"}, "measured", "0.5", "longer_findings('C10a').measured"),
    (
        "longer_peaks",
        {"E": 2, "K": 0.5, "theta": 0.15, "order": 4},
        "amplitude",
        0.1,
        "longer_peaks('2nd',2,0.5,0.15,4).amplitude",
    ),
    (
        "longer_divergence",
        {"casing": "2nd5nd", "status": "unbounded", "revolutions": 18},
        "runs",
        99,
        "longer_divergence.column('runs',status='unbounded'",
    ),
    (
        "twisted_plate_blade_comparison",
        {"blade": "this", "number": "f1"},
        "value",
        1.0,
        "twisted_plate_blade_comparison('this','f1')",
    ),
    (
        "twisted_plate_blade_comparison_runs",
        {"f_omega": 0.13},
        "lobes",
        9,
        "twisted_plate_blade_comparison_runs.rows.query",
    ),
    ("twisted_plate_peaks", {"order": 4}, "f_peak", 0.5, "twisted_plate_peaks('2nd',2,0.5,0,4)"),
    (
        "twisted_plate_divergence",
        {"revolutions": 20, "divergent": False, "saturating": False},
        "runs",
        1000,
        "twisted_plate_divergence.column('runs')|sum",
    ),
    ("chart", {"E": 1.1, "K": 0.3, "theta": 0}, "Y4", 1.0, "chart('2nd',1.1,0.3,0).Y4"),
    (
        "chart_explanation",
        {"E": 2, "K": 0.3, "theta": 0, "order": 4},
        "wear_per_cycle",
        1e3,
        "chart_explanation.rows.query('order==4 and theta==0 and E==2",
    ),
    ("chart_agreement", {"E": 2, "K": 0.5, "theta": 0, "quantity": "Y4"}, "disagreement", 1, "'Y4',disagree"),
    ("chart_placement_summary", {"quantity": "Y6"}, "exact", 1, "chart_placement_summary.rows|table"),
    (
        "chart_ridge_summary",
        {"theta": 0, "order": 4, "speed_step": 0.002},
        "amplitude",
        1.0,
        "chart_ridge_summary.rows|table",
    ),
    (
        "chart_stiffening",
        {"theta": 0, "order": 4},
        "rank_correlation_E_T",
        0.1,
        "chart_stiffening.rows.query('theta==0 and order==4').iloc[0].rank_correlation_E_T",
    ),
    ("gpu", {"gpu_runs": 11904}, "kernel_s", 1.0, "gpu.rows.assign"),
    ("schedule", {"cores": 16}, "efficiency", 0.1, "schedule.rows"),
    ("cost", {"stage": "blade"}, "memory_mb", 9999.0, "cost.column('memory_mb')|max"),
    (
        "finer_bars",
        {"E": 0.11, "order": 4, "elements": 4000},
        "f_peak",
        0.5,
        "finer_bars('2nd',0.11,0.5,0,4,4000).f_peak",
    ),
    (
        "more_nodes",
        {"E": 0.11, "order": 4, "interface_nodes": 16},
        "f_peak",
        0.5,
        "more_nodes('2nd',0.11,0.5,0,4,16).f_peak",
    ),
    (
        "rigid_convergence",
        {"f_omega": 0.25, "treatment": "exponential", "steps": 20},
        "amplitude",
        1.0,
        'f_omega==0.25 and treatment=="exponential"',
    ),
    (
        "rotor",
        FOUR_BLADES,
        "unbounded_rows",
        1,
        "rotor('2nd',1.1,0.5,0.0,0.346,4,0.00005,0.005,0.0).unbounded_rows",
    ),
    (
        "rotor_half",
        FOUR_BLADES,
        "unbounded_rows",
        1,
        "rotor_half('2nd',1.1,0.5,0.0,0.346,4,0.00005,0.005,0.0).unbounded_rows",
    ),
    (
        "rotor_drift",
        {"E": 1.1, "f_omega": 0.346, "blades": 4, "length_scatter": 5e-5, "coupling": 0},
        "pattern_drift_median",
        1.0,
        "rotor_drift.rows.query",
    ),
    ("tip_turns_findings", {"id": "C2d"}, "holds", "yes", "tip_turns_findings('C2d').holds"),
    (
        "tip_turns_peaks",
        {"E": 0.11, "K": 0.5, "theta": 0, "order": 4},
        "f_peak",
        0.5,
        "tip_turns_peaks('2nd',0.11,0.5,0,4).f_peak",
    ),
    ("identification_waves", {"wave": 1}, "remaining", 0.01, "identification_waves.rows.remaining"),
    (
        "identification_targets",
        {"target": "growth_C11a"},
        "plausible",
        0.01,
        "identification_targets.rows.plausible.sort_values",
    ),
    (
        "identification_candidates",
        {"candidate": 1, "neighbour": 0, "factor": "unit"},
        "value",
        1.0,
        "identification_candidates.rows.query",
    ),
    (
        "identification_counts",
        {"candidate": 0, "neighbour": 0},
        "yes",
        1,
        "identification_counts.rows.replace",
    ),
    (
        "identification_emulators",
        {"target": "f4_soft"},
        "explained",
        -1.0,
        "identification_emulators.rows.explained.min()",
    ),
    (
        "identification_exclusions",
        {"id": "C2a", "other_id": "C8a"},
        "other_id",
        "C9z",
        "identification_exclusions.rows.other_id",
    ),
    ("identification_ranges", {"factor": "unit"}, "lowest", 1.0, "identification_ranges.rows.merge"),
    ("rotor37_blade", {"number": "f1_rest"}, "value", 1.0, "rotor37_blade('f1_rest').value"),
    (
        "rotor37_direct",
        {"number": "rest_mu0.order_2"},
        "value",
        1.0,
        "rotor37_direct('rest_mu0.order_2').value",
    ),
    (
        "rotor37_interaction",
        {"number": "bumps_rigid_mu0.order_4.speed"},
        "value",
        1.0,
        "rotor37_interaction('bumps_rigid_mu0.order_4.speed').value",
    ),
    (
        "rotor37_coatings",
        {"number": "bumps_E0.1_K0.5_theta0.order_4.speed"},
        "value",
        1.0,
        "rotor37_coatings('bumps_E0.1_K0.5_theta0.order_4.speed').value",
    ),
    (
        "rotor37_independent",
        {"treatment": "massless", "modes": 10, "steps": 20, "number": "rest_mu0.amplitude"},
        "value",
        1.0,
        "rotor37_independent('massless',10,20,'rest_mu0.amplitude')",
    ),
    (
        "rotor37_nlstep",
        {"modes": 20, "steps_per_revolution": 3000, "number": "rest_mu0.15.order_6"},
        "value",
        1.0,
        "rotor37_nlstep(20,3000,'rest_mu0.15.order_6')",
    ),
    (
        "rotor37_more_nodes",
        {"E": 1, "theta": 0, "order": 4, "interface_nodes": 16},
        "amplitude",
        1.0,
        "rotor37_more_nodes.rows.query('interface_nodes > 8')|table",
    ),
    (
        "long_runs",
        {"law": "theta", "why": "grows", "revolutions": 500, "verdict": "unbounded"},
        "runs",
        1000,
        "why='grows',revolutions=500,verdict='unbounded'",
    ),
    ("robustness", {"id": "C11k"}, "yes_share", 0.9, "robustness('C11k').yes_share"),
    (
        "laws_calibration",
        {"set": "viscoplastic_2e4", "id": "C10b"},
        "measured",
        "0.5",
        "'viscoplastic_2e4','C10b'",
    ),
    ("calibration", {"set": "start", "id": "C7b"}, "holds", "no", "calibration.count(id='C7b'"),
    ("calibration_counts", {"set": "cone_14"}, "yes", 40, "= calibration_counts.rows|table"),
    ("laws_calibration_counts", {"set": "brittle_0.03"}, "yes", 40, "laws_calibration_counts.rows"),
    ("heat", {"theta": 0.15, "softening_rise": 300}, "max_wear", 0.01, "heat.rows|table"),
    ("heat_calibration", {"set": "thermal_1", "id": "C10a"}, "measured", "0.5", "'thermal_1','C10a'"),
    ("heat_calibration_counts", {"set": "thermal_1"}, "yes", 40, "heat_calibration_counts('thermal_1')"),
    (
        "stress",
        {"casing": "2nd", "E": 11, "K": 1, "theta": 0, "order": 4},
        "last_von_mises",
        1e10,
        "stress.rows.last_von_mises.max()",
    ),
]
"""A snapshot, one of its rows, a value of that row, another value, and what quotes it."""


@pytest.mark.parametrize(("table", "key", "column", "value", "mark"), CHANGES)
def test_a_changed_value_of_any_snapshot_names_the_lines_that_quote_it(
    snapshots, table, key, column, value, mark
):
    places = places_after_change(snapshots, table, key, column, value)
    assert lines_of(mark)
    assert all(set(lines) & set(places) for lines in lines_of(mark))
    assert set(places) <= set().union(*lines_of(table))


def test_each_snapshot_that_a_page_quotes_has_such_a_change():
    quoted = {
        name
        for page in pages.pages_of(ROOT)
        for mark in pages.MARK.finditer(page.read_text(encoding="utf-8"))
        for name in re.findall(r"(?<!['\w.])[a-z]\w*(?=\(|\.)", mark["source"] or "")
    } & set(pages.read_tables(SNAPSHOTS))
    assert len(quoted) > 20
    assert quoted == {table for table, *_ in CHANGES}


def test_a_changed_verdict_names_the_sentences_written_for_the_old_one(tmp_path):
    folder = changed_snapshots(
        tmp_path / "data", "1,partly,-0.029820502301695917", "1,no,-0.029820502301695917"
    )
    written = [one for one in stale_places(folder) if "written for" in one]
    assert [place(one) for one in written] == places_with("<!-- C4c: partly -->")
    assert len(written) == 3
    assert all("C4c is no" in one for one in written)


@pytest.mark.parametrize(
    "line",
    [
        "<!-- = nowhere('C1a').measured -->1<!-- / -->",
        "<!-- = findings('C1a').nothing -->1<!-- / -->",
        "<!-- = findings('C99').measured -->1<!-- / -->",
        "<!-- = findings( -->1<!-- / -->",
        "<!-- = findings('C1a').measured | unheard -->1<!-- / -->",
        "<!-- = findings('C1a').measured -->1",
        "<!-- = findings('C1a').measured -->1 <!-- = 2 -->2<!-- / -->",
        "1<!-- / -->",
    ],
)
def test_an_error_names_page_and_line(line):
    with pytest.raises(pages.PageError, match=r"^page\.md:2: "):
        pages.render(f"first\n{line}\n", "page.md", pages.read_tables(SNAPSHOTS))


def test_a_page_that_quotes_a_snapshot_that_was_not_taken_names_it():
    with pytest.raises(pages.PageError, match=r"^page\.md:1: .*untaken\.csv"):
        pages.render("<!-- = untaken.count() -->1<!-- / -->", "page.md", pages.read_tables(SNAPSHOTS))


def test_no_mark_stands_in_a_block_of_code_which_would_show_it():
    block = re.compile(r"^ *```.*?^ *```", re.DOTALL | re.MULTILINE)
    blocks = [
        code for page in pages.pages_of(ROOT) for code in block.findall(page.read_text(encoding="utf-8"))
    ]
    assert len(blocks) > 20
    assert [code for code in blocks if pages.MARK.search(code)] == []


def test_a_verdict_of_an_unknown_claim_is_an_error():
    with pytest.raises(pages.PageError, match=r"^page\.md:1: "):
        pages.differences("<!-- C99: yes -->so", "page.md", pages.read_tables(SNAPSHOTS))


def test_rendering_twice_changes_nothing():
    data = pages.read_tables(SNAPSHOTS)
    once = pages.render("a <!-- = findings.count(holds='yes') --><!-- / --> b", "page.md", data)
    assert once == "a <!-- = findings.count(holds='yes') -->32<!-- / --> b"
    assert pages.render(once, "page.md", data) == once


def test_rows_are_written_as_a_table_and_a_changed_one_is_named(tmp_path):
    data = pages.read_tables(SNAPSHOTS)
    source = "cost.rows[['stage','job']].query(\"stage == 'blade'\")|table"
    rendered = pages.render(f"before\n<!-- = {source} --><!-- / -->\nafter\n", "page.md", data)
    assert rendered.split("\n")[2:6] == ["| stage | job |", "| --- | --- |", "| blade |  |", "<!-- / -->"]
    assert pages.differences(rendered, "page.md", data) == []
    old = rendered.replace("| blade |", "| wheel |")
    assert pages.differences(old, "page.md", data) == ["page.md:5: stale number, now: | blade |  |"]
    shorter = rendered.replace("| blade |  |\n", "")
    assert pages.differences(shorter, "page.md", data) == ["page.md:5: stale number, now: | blade |  |"]
    longer = rendered.replace("| blade |  |\n", "| wheel |  |\n| blade |  |\n")
    assert pages.differences(longer, "page.md", data) == ["page.md:5: stale number, now: no such line"]


def test_no_mark_begins_a_line_which_would_make_it_plain_html():
    begins = re.compile(r"\s*(?:[*-] )?<!-- (?:=(?!.*\|table(?:\(.*\))? -->$)|C\d)")
    assert not begins.match("<!-- = cost.rows|table -->")  # the table begins on the next line
    lines = [line for page in pages.pages_of(ROOT) for line in page.read_text(encoding="utf-8").split("\n")]
    assert begins.match("* <!-- C1a: yes -->so")
    assert [line for line in lines if begins.match(line)] == []


def test_no_mark_in_a_table_has_a_pipe_that_would_end_its_cell():
    ends = re.compile(r"^\|.*<!-- = (?:(?! -->).)*(?<!\\)\|(?:(?! -->).)* -->")
    lines = [line for page in pages.pages_of(ROOT) for line in page.read_text(encoding="utf-8").split("\n")]
    assert ends.match("| <!-- = 1|fixed -->1<!-- / --> |")
    assert [line for line in lines if ends.match(line)] == []


def test_a_column_of_chosen_rows_is_summed():
    data = pages.read_tables(SNAPSHOTS)
    source = "divergence.column('runs', E=[0.05, 0.11], divergent=true) | sum"
    table = data["divergence"].rows
    expected = table[(table.E <= 0.11) & table.divergent].runs.sum()
    assert expected > 0
    assert pages.render(f"<!-- = {source} --><!-- / -->", "page.md", data).count(f">{expected}<") == 1


def test_metres_are_shown_in_millimetres():
    rendered = pages.render("<!-- = 0.00234 | mm(2) --><!-- / -->", "page.md", {})
    assert rendered == "<!-- = 0.00234 | mm(2) -->2.34<!-- / -->"


def test_radians_are_shown_in_degrees():
    rendered = pages.render("<!-- = 0.5236 | degrees(2) --><!-- / -->", "page.md", {})
    assert rendered == "<!-- = 0.5236 | degrees(2) -->30.00<!-- / -->"


def test_a_table_has_the_columns_that_it_is_asked_for():
    rows = pd.DataFrame({"E": [1.0, 2.0], "wear": [1.234e-3, None], "left_out": [0, 0]})
    written = pages._table(rows, "E:fixed(0)", "wear:mm(2) = wear, mm")
    assert written == "\n| E | wear, mm |\n| --- | --- |\n| 1 | 1.23 |\n| 2 |  |\n"


def test_numbers_of_all_sizes_are_written_with_significant_digits():
    rows = pd.DataFrame({"value": [6.8632e8, 0.0007391, 12.25, 0.0]})
    written = pages._table(rows, "value:significant(3)").split("\n")[3:-1]
    assert written == ["| 6.86e+08 |", "| 0.000739 |", "| 12.2 |", "| 0 |"]


@pytest.mark.parametrize("column", ["wear:mm", "wear:cm(2)", "wear, mm"])
def test_a_column_that_cannot_be_read_is_an_error(column):
    with pytest.raises(pages.PageError, match=re.escape(f"{column}: must be a column")):
        pages.render(
            f"<!-- = findings.rows|table('{column}') --><!-- / -->", "page.md", pages.read_tables(SNAPSHOTS)
        )


def test_a_page_names_the_commit_of_a_table():
    data = pages.read_tables(SNAPSHOTS)
    commit = tables.read_origin(SNAPSHOTS / "robustness.csv")["provenance_git_commit"]
    assert data["robustness"].commit == commit[:7]
