# The pictures that the pages show, which are committed: of the study as a whole, and what rules of studies add. Not
# part of `all`.
from pathlib import Path

PICTURES["images"] = {
    f"docs/images/{Path(path).name}": Picture(path, 12 if "history" in Path(path).name else 48)
    for output in FIGURES
    for path in output
    if path.endswith(".png") and Path(path).parent == Path(PLOTS)
}

for target, pictures in PICTURES.items():

    rule:
        name:
            target
        input:
            [picture.figure for picture in pictures.values()],
        output:
            list(pictures),
        log:
            f"{RESULTS}/logs/{target}.log",
        params:
            pictures=[picture[1:] for picture in pictures.values()],
        script:
            "../scripts/images.py"
