"""Make the figures small enough to be kept with the documents."""

import sys

from PIL import Image

sys.stderr = open(snakemake.log[0], "w", buffering=1)

for figure, small in zip(snakemake.input, snakemake.output, strict=True):
    with Image.open(figure) as image:
        image.convert("RGB").quantize(snakemake.params.colours, dither=Image.Dither.NONE).save(
            small, optimize=True
        )
