"""Make the figures small enough to be kept with the documents."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from PIL import Image

from bladerub.io import atomic

for figure, small in zip(snakemake.input, snakemake.output, strict=True):
    with Image.open(figure) as image, atomic.writing(small, "wb") as stream:
        smaller = image.convert("RGB").reduce(snakemake.params.get("shrink", 1))
        colours = 12 if small in snakemake.params.get("few", []) else snakemake.params.colours
        few = smaller.quantize(colours, dither=Image.Dither.NONE)
        few.save(stream, format="PNG", optimize=True)
