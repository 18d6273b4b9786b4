# docker build -t macroslip . && docker run --rm -v "$PWD:/work" macroslip run case.yaml -o case.nc
FROM python:3.12-slim

RUN useradd --create-home --uid 1000 macroslip
COPY . /source
RUN pip install --no-cache-dir "/source[all]" && rm -rf /source

USER 1000
# Kernels are compiled for the processor that builds the image; another one compiles them again.
RUN macroslip doctor --warm
WORKDIR /work
ENTRYPOINT ["macroslip"]
CMD ["--help"]
