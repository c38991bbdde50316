# Renders without a GPU or a display, through Mesa's lavapipe and as a user without privileges:
#   docker build --tag glimray .
#   docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD:/work" glimray render scene.toml -o picture.png
FROM rust:1.95-slim-bookworm AS build
# FLIP and the H.264 encoder are C++.
RUN apt-get update && \
    apt-get install --yes --no-install-recommends g++ && \
    rm -rf /var/lib/apt/lists/*
WORKDIR /source
COPY . .
# Everything but the window and OpenGL.
RUN cargo build --release --locked --no-default-features --features archive,basis,draco,flip,parallel,video

FROM debian:bookworm-slim
RUN apt-get update && \
    apt-get install --yes --no-install-recommends libvulkan1 mesa-vulkan-drivers && \
    rm -rf /var/lib/apt/lists/* && \
    useradd --no-create-home glimray
COPY --from=build /source/target/release/glimray /usr/local/bin/glimray
# Any user may write the driver's cache there.
ENV XDG_CACHE_HOME=/tmp NODEVICE_SELECT=1
USER glimray
WORKDIR /work
ENTRYPOINT ["glimray"]
CMD ["--help"]
