#!/bin/sh
# Start to first script line, and memory with 1000 child scripts.
set -eu
cd "$(dirname "$0")/.."
cargo build --release --quiet
bin=target/release/swanilda
dir=$(mktemp -d)
trap 'rm -r "$dir"' EXIT

echo "os.exit(0)" > "$dir/first.lua"
runs=100
begun=$(date +%s%N)
i=0
while [ $i -lt $runs ]; do
    "$bin" run "$dir/first.lua" --quiet
    i=$((i + 1))
done
echo "start to first script line: $((($(date +%s%N) - begun) / runs / 1000)) us (process start included)"

cat > "$dir/many.lua" <<'LUA'
sim = require 'sim'
local code = 'function sysCall_init() end function sysCall_actuation() end function sysCall_sensing() end'
for _ = 1, 1000 do
    local script = sim.createScript(sim.scripttype_simulation, code)
    sim.setObjectParent(script, sim.createDummy(0.1), true)
end
function sysCall_sensing()
    for line in io.lines('/proc/self/status') do
        if line:match('^VmRSS') then print('memory with 1000 child scripts: ' .. line) end
    end
    sim.stopSimulation()
end
LUA
"$bin" run "$dir/many.lua" --quiet | head -1
