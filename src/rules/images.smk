# The pictures that the pages show, which are committed. Not part of `all`.
from pathlib import Path

IMAGES = [
    Path(path).name
    for output in FIGURES
    for path in output
    if path.endswith(".png") and Path(path).parent == Path(PLOTS)
]


rule images:
    input:
        [f"{PLOTS}/{name}" for name in IMAGES],
    output:
        [f"docs/images/{name}" for name in IMAGES],
    log:
        f"{RESULTS}/logs/images.log",
    params:
        colours=48,
        few=[f"docs/images/{name}" for name in IMAGES if "history" in name],  # lines
    script:
        script_of("images")
