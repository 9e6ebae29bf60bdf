from typing import NamedTuple


class Mistake(NamedTuple):
    """A file, the line and the key of the mistake, words of the answer, and whether a schema can see it."""

    text: str
    line: int
    key: str
    right: str
    in_schema: bool = True


CASING = "nodal_diameters: [3], weights: [1.0], amplitude: 1.0e-3"
WHOLE = f"{CASING}, interference: 5.0e-4, start_angle: 90.0"
ROWS = [
    ("blade:\n  length: 200\n", 2, "blade.length", 'to 3, in m; this is 200 m; write "200 mm"'),
    ("blade: {lenght: 0.2}\n", 1, "blade.lenght", "did you mean blade.length?"),
    ("blade:\n", 1, "blade", "a group of keys"),
    ("blade:\n  mesh: {chordwise: 14.5}\n", 2, "blade.mesh.chordwise", "a whole number from 4 to 200"),
    ("blade:\n  source: {file: no.msh, root_set: A}\n", 2, "blade.source.file", "no such file", False),
    ("extend: config/quick.yaml\n", 1, "extend", "both files, the one named here first"),
    ("contact:\n  elements: 020\n", 2, "contact.elements", "YAML reads this as 16, as octal"),
    ("contact: {law: {file: no.py}}\n", 1, "contact.law.file", "no such file", False),
    ("contact: {law: {name: plastik}}\n", 1, "contact.law.name", "must be one of plastic, brittle", False),
    (f"casings:\n  3rd: {{{CASING}}}\n", 2, "casings.3rd.interference", "missing, must be a", False),
    (f"casings:\n  my casing: {{{WHOLE}}}\n", 2, 'casings["my casing"]', "at most 40 letters and digits"),
    ("casings: {2nd: {weights: [1, 2]}}\n", 1, "casings.2nd.weights", "must be 1, one for each of", False),
    ("coatings:\n  - {casing: 2nd, E: [1],\n     K: [-2], theta: [0.0]}\n", 3, "coatings[0].K[0]", "1e+06"),
    ("coatings: [{casing: 5nd, E: [1], K: [2], theta: [0]}]\n", 1, "coatings[0].casing", "2nd5nd", False),
    ("coatings: [{casing: 2nd, E: 2, K: [0.5], theta: [0.0]}]\n", 1, "coatings[0].E", "a list of 1 to 1000"),
    ("speeds: {start: 2000}\n", 1, "speeds.start", 'write "2000 rpm"'),
    ("speeds: {stop: 0.5}\n", 1, "speeds.stop", "at most reduction.f_omega_max = 0.4", False),
    ("solver:\n  scheme: euler\n", 2, "solver.scheme", "exponential or central_differences"),
    ("analysis: {peaks: {speed_window: [1.2, 1.1]}}\n", 1, "analysis.peaks.speed_window[1]", "(1.2)", False),
    ("contact:\n  damping_ratio: 0,0023\n", 2, "contact.damping_ratio", "a number of at least 0"),
    ("figures:\n  dpi: 2\nfigure: {dpi: 200}\n", 3, "figure", "did you mean figures?"),
    ("solver: {revolutions: yes}\n", 1, "solver.revolutions", "a whole number from 1 to 10000"),
    ("analysis: {peaks: {orders: [4, 4]}}\n", 1, "analysis.peaks.orders", "must not name one twice"),
    ("results: ../elsewhere\n", 1, "results", "a folder below"),
    ("contact:\n  tip_profile: {edge_drop: 20}\n", 2, "contact.tip_profile.edge_drop", 'write "20 µm"'),
    ("solver: {device: gpgpu}\n", 1, "solver.device", "must be cpu"),
]
BOTH = "coatings: [{casing: 2nd, E: [1], K: [2], theta: [0.0], friction: [0.1]}]\n"
MISTAKES = [Mistake(*row) for row in (*ROWS, (BOTH, 1, "coatings[0].theta", "unknown key"))]
