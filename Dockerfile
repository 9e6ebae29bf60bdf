# The study in a container: docker build -t bladerub . && mkdir -p results .snakemake && \
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD/results:/bladerub/results" -v "$PWD/.snakemake:/bladerub/.snakemake" bladerub
FROM python:3.12-slim
WORKDIR /bladerub
COPY . .
RUN python -m venv .venv && .venv/bin/pip install --no-cache-dir -r environment.txt
# Any user number may run it (docker run --user): what is kept beside the results goes to /tmp
ENV HOME=/tmp XDG_CACHE_HOME=/tmp/cache BLADERUB_CACHE=/tmp/cache/bladerub
ENV NUMBA_CACHE_DIR=/tmp/cache/numba MPLCONFIGDIR=/tmp/cache/matplotlib
ENTRYPOINT [".venv/bin/snakemake", "-j2"]
