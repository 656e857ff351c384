#!/bin/sh
# Makes the scene files of this folder anew: tests/data/make.sh target/debug/swanilda [FOLDER]
set -eu
swanilda=$(realpath "$1")
source=$(dirname "$(realpath "$0")")
target=$(realpath "${2:-$source}")
unpacked=$(mktemp -d)
trap 'rm -r "$unpacked"' EXIT

for script in robot world; do
    "$swanilda" run "$source/$script.lua" --as sandbox --no-start --quiet -D source="$source" -D target="$target"
done
# What the reader of folders and the writer of binary files make of it.
"$swanilda" unpack "$target/world.ttt" "$unpacked/world"
"$swanilda" pack "$unpacked/world" "$target/world.ttt"
