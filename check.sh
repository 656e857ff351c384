#!/bin/sh
# Everything that must hold before a change goes in. The commands a newcomer runs are taken from README.md, so that they stay true.
set -eu
cd "$(dirname "$0")"

# The command README.md shows after the comment "# <label>".
readme_command() {
    sed -n "/^# $1\$/{n;p;q}" README.md
}

run=$(readme_command "build and run a scene")
test=$(readme_command "run the tests")
[ -n "$run" ] && [ -n "$test" ] || { echo "check.sh: README.md has lost its set-up commands" >&2; exit 1; }

step() { echo "== $*"; "$@"; }

step cargo fmt --all --check
# With what is off by default.
step cargo clippy --workspace --all-targets --features swanilda/video --quiet -- -D warnings
step sh -c "$test"
step cargo build --release
step sh -c "$run"
echo "== all good"
