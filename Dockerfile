# The command `swanilda` in a small image, for a user who is not root.
#
#     docker build -t swanilda .
#     docker run --rm -v "$PWD:/work" swanilda run robot.ttt --time 5
FROM rust:1.89-slim-bookworm AS build
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends g++ make npm pkg-config && rm -rf /var/lib/apt/lists/*
WORKDIR /source
COPY . .
RUN cargo build --profile dist --locked --bin swanilda && cargo build --profile dist --locked -p swanilda-library

FROM debian:bookworm-slim
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends ca-certificates libstdc++6 && rm -rf /var/lib/apt/lists/* \
    && useradd --create-home --uid 1000 swanilda
COPY --from=build /source/target/dist/swanilda /usr/local/bin/swanilda
# For `swanilda library`: programs that load CoppeliaSim in their own process.
COPY --from=build /source/target/dist/libswanilda_library.so /usr/local/lib/swanilda/
COPY LICENSE-MIT LICENSE-APACHE /usr/share/doc/swanilda/
USER swanilda
WORKDIR /work
# The remote APIs, when the command is `serve --bind 0.0.0.0`.
EXPOSE 23000 23050
HEALTHCHECK --interval=30s --timeout=5s CMD ["swanilda", "--version"]
ENTRYPOINT ["swanilda"]
CMD ["--help"]
