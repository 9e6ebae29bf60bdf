# The pictures of the README and of docs/, committed; made again when the study changes. Not part of `all`.
from pathlib import Path

IMAGES = [
    Path(path).name
    for output in [*FIGURES, rules.margins.output]
    for path in output
    if path.endswith(".png")
]


rule images:
    input:
        [f"{PLOTS}/{name}" for name in IMAGES],
    output:
        [f"docs/images/{name}" for name in IMAGES],
    log:
        f"{RESULTS}/logs/images.log",
    threads: 1
    params:
        colours=96,
    script:
        "../scripts/images.py"
