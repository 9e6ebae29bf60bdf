# The study in a container: docker build -t bladerub . && docker run --rm -v "$PWD/results:/bladerub/results" bladerub
FROM python:3.12-slim
WORKDIR /bladerub
COPY . .
RUN python -m venv .venv && .venv/bin/pip install --no-cache-dir -r environment.txt
ENTRYPOINT [".venv/bin/snakemake", "-j2"]
