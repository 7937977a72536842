# docker build -t irk . && docker run --rm -v "$PWD:/data" irk solve van_der_pol --tol 1e-8
# Debian 12, whose SUNDIALS is version 6.
FROM debian:bookworm-slim
ENV LANG=C.UTF-8
COPY . /irk
# Compiled for any processor: the image may run on another one. Precompiled headers, 1 GB, serve the build only.
RUN IRK_CMAKE_ARGS="-DIRK_NATIVE=OFF -DIRK_TESTS=OFF" /irk/irk build && \
    find /irk/build -name '*.gch' -delete && rm -rf /var/lib/apt/lists/*
WORKDIR /data
ENTRYPOINT ["/irk/build/release/irk"]
