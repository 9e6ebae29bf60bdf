"""Make the figures small enough to be kept with the documents."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from PIL import Image

from bladerub.io import atomic

for figure, small, (colours, shrink) in zip(
    snakemake.input, snakemake.output, snakemake.params.pictures, strict=True
):
    with Image.open(figure) as image, atomic.writing(small, "wb") as stream:
        # by an octree: a median cut gives colours of few pixels up, such as red marks
        few = image.convert("RGB").reduce(shrink).quantize(colours, Image.Quantize.FASTOCTREE)
        few.save(stream, format="PNG", optimize=True)
