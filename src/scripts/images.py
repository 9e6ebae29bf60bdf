"""Make the figures small enough to be kept with the documents."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from PIL import Image

from bladerub.io import atomic

for figure, small, (colours, shrink) in zip(
    snakemake.input, snakemake.output, snakemake.params.pictures, strict=True
):
    with Image.open(figure) as image, atomic.writing(small, "wb") as stream:
        # a median cut gives up colours of few pixels, such as red marks; an octree makes pale ones white
        reduced, method = image.convert("RGB").reduce(shrink), Image.Quantize.MAXCOVERAGE
        few = reduced.quantize(colours, method, kmeans=4)
        few.save(stream, format="PNG", optimize=True)
