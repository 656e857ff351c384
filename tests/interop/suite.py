"""Tests in Lua that say all that a report must be able to show."""

import pathlib
import subprocess
import sys

LIMIT = 60  # seconds

HOSTILE = "<script>document.title = 'bad'</script> ]]> & \"q\" # -->"

DRIVE = """
local sim = require 'sim'
local t = require 'swanilda.test'
local function box(height)
    local handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectInt32Param(handle, sim.shapeintparam_static, 0)
    sim.setObjectPosition(handle, {0, 0, height})
    t.golden('fall', {['z <b>'] = function() return sim.getObjectPosition(handle)[3] end})
    t.run_for(0.2)
end
it('falls', function() box(HEIGHT) print([=[HOSTILE]=]) print('\\0 \\27[31m \\xff') end)
it([=[HOSTILE]=], function() error([=[HOSTILE]=]) end)
it('breaks a script', function()
    sim.createScript(sim.scripttype_simulation, 'function sysCall_sensing() nothing.at = 1 end')
    t.step(2)
end)
"""

PLAIN = """
it('passes', function() print('nee' .. 'dle') end)
it('fails', function()
    assert.equal(1, 2)
end)
it('is to be written')
"""


def run(program, folder, *args):
    """Runs the tests with a golden trace that differs; what came to standard output."""
    folder = pathlib.Path(folder)
    write(folder, "1")
    call(program, folder, "--update-golden")
    write(folder, "1.5")
    return call(program, folder, *args)


def write(folder, height):
    drive = DRIVE.replace("HOSTILE", HOSTILE).replace("HEIGHT", height)
    folder.joinpath("drive_test.lua").write_text(drive)
    folder.joinpath("plain_test.lua").write_text(PLAIN)


def call(program, folder, *args):
    done = subprocess.run([program, "test", "-j1", *args], cwd=folder, capture_output=True, timeout=LIMIT)
    if done.returncode != 1:
        sys.exit(f"exit code {done.returncode}: {done.stderr.decode()}")
    return done.stdout.decode()
