from typing import NamedTuple


class Mistake(NamedTuple):
    """A file, the line and the key of the mistake, words of the answer, and whether a schema can see it."""

    text: str
    line: int
    key: str
    right: str
    in_schema: bool = True


MISTAKES = [
    Mistake(
        "blade:\n  length: 200\n",
        2,
        "blade.length",
        'a number from 0.01 to 3, in m; this is 200 m; write "200 mm"',
    ),
    Mistake("blade: {lenght: 0.2}\n", 1, "blade.lenght", "did you mean blade.length?"),
    Mistake("extend: config/quick.yaml\n", 1, "extend", "both files, the one named here first"),
    Mistake("contact:\n  damping_ratio: 1.0\n", 2, "contact.damping_ratio", "of at least 0 and below 1"),
    Mistake(
        "contact:\n  layer_thickness: 6 MPa\n",
        2,
        "contact.layer_thickness",
        "is a pressure; must be a length: mm",
    ),
    Mistake("contact:\n  elements: 020\n", 2, "contact.elements", "YAML reads this as 16, as octal"),
    Mistake(
        "casings:\n  3rd: {nodal_diameters: [3], weights: [1.0], amplitude: 1.0e-3}\n",
        2,
        "casings.3rd.interference",
        "missing, must be a number above 0",
        in_schema=False,
    ),
    Mistake(
        "casings:\n  2nd:\n    weights: [1.0, 2.0]\n",
        3,
        "casings.2nd.weights",
        "must be 1, one for each of nodal_diameters",
        in_schema=False,
    ),
    Mistake(
        "coatings:\n  - {casing: 2nd, E: [1],\n     K: [-2], theta: [0.0]}\n",
        3,
        "coatings[0].K[0]",
        "a number from 0 to 1e+06 (times contact.modulus_unit",
    ),
    Mistake(
        "coatings:\n  - {casing: 5nd, E: [1], K: [2], theta: [0.0]}\n",
        2,
        "coatings[0].casing",
        "must be one of the casings, 2nd, 2nd5nd",
        in_schema=False,
    ),
    Mistake(
        "coatings:\n  - {casing: 2nd, E: [1], K: [2], theta: [0.0], friction: [0.1]}\n",
        2,
        "coatings[0].theta",
        "unknown key",
    ),
    Mistake(
        "speeds:\n  stop: 0.5\n", 2, "speeds.stop", "at most reduction.f_omega_max = 0.4", in_schema=False
    ),
    Mistake("solver:\n  scheme: euler\n", 2, "solver.scheme", "exponential or central_differences"),
    Mistake(
        "analysis:\n  peaks: {speed_window: [1.2, 1.1]}\n",
        2,
        "analysis.peaks.speed_window[1]",
        "above the one before (1.2)",
        in_schema=False,
    ),
    Mistake("results: ../elsewhere\n", 1, "results", "a folder below"),
    Mistake("figures:\n  dpi: 2\nfigure: {dpi: 200}\n", 3, "figure", "did you mean figures?"),
    Mistake("blade:\n  material:\n    density: 4.43\n", 3, "blade.material.density", 'write "4.43 g/cm3"'),
    Mistake("blade:\n  mesh: {chordwise: 14.5}\n", 2, "blade.mesh.chordwise", "a whole number from 4 to 200"),
    Mistake(
        "blade:\n  source: {file: missing.msh, root_set: ROOT}\n",
        2,
        "blade.source.file",
        "there is no such file",
        in_schema=False,
    ),
    Mistake("reduction:\n  modes_per_speed: six\n", 2, "reduction.modes_per_speed", "a whole number from 1"),
    Mistake("contact:\n  damping_ratio: 0,0023\n", 2, "contact.damping_ratio", "a number of at least 0"),
    Mistake(
        "contact:\n  law: {name: plastik}\n",
        2,
        "contact.law.name",
        "must be one of plastic, brittle",
        in_schema=False,
    ),
    Mistake(
        "casings:\n  my casing: {nodal_diameters: [2], weights: [1.0],\n    amplitude: 1.0e-3, "
        "interference: 0.5e-3, start_angle: 90.0}\n",
        2,
        'casings["my casing"]',
        "at most 40 letters and digits",
    ),
    Mistake(
        "coatings:\n  - {casing: 2nd, E: 2, K: [0.5], theta: [0.0]}\n",
        2,
        "coatings[0].E",
        "a list of 1 to 1000 entries",
    ),
    Mistake(
        "coatings:\n  - {casing: 2nd, E: [2], K: [0.5], theta: [8.6]}\n",
        2,
        "coatings[0].theta[0]",
        'write "8.6 deg"',
    ),
    Mistake("speeds:\n  start: 2000\n", 2, "speeds.start", 'write "2000 rpm"'),
    Mistake("solver:\n  revolutions: yes\n", 2, "solver.revolutions", "a whole number from 1 to 10000"),
    Mistake("analysis:\n  divergence:\n    confidence: 95\n", 3, "analysis.divergence.confidence", "0.9999"),
    Mistake("ensemble: {members: -8}\n", 1, "ensemble.members", "a whole number from 0 to 1000"),
    Mistake("blade:\n", 1, "blade", "a group of keys"),
]
