-- as: sandbox
-- passes: 0
-- spec: motion 1; Ruckig: lists, flags, selection, codes, the end inside a cycle, the old names
-- tol: 1e-6
-- topic: motion
sim = require 'sim'
local trial = require 'lib.trial'
local try, text = trial.try, trial.text

local CYCLE <const> = 0.0001
local pos, vel, step = sim.ruckigPos, sim.ruckigVel, sim.ruckigStep

try('few', pos, 1, CYCLE)
try('short', pos, 1, CYCLE, -1, {0, 0}, {0.5, 1, 10}, {1}, {1, 0})
try('no minima', pos, 1, CYCLE, sim.ruckig_minvel, {0, 0, 0}, {0.5, 1, 10}, {1}, {1, 0})
try('no axes', pos, 0, CYCLE, -1, {}, {}, {}, {})
try('-1 axes', pos, -1, CYCLE, -1, {0, 0, 0}, {0.5, 1, 10}, {1}, {1, 0})
try('many axes', pos, 1e15, CYCLE, -1, {0, 0, 0}, {0.5, 1, 10}, {1}, {1, 0})
try('infinite', pos, 1, CYCLE, -1, {1 / 0, 0, 0}, {0.5, 1, 10}, {1}, {1, 0})
try('nan', vel, 1, CYCLE, -1, {0, 0, 0}, {1, 0 / 0}, {1}, {1})
for _, cycle in ipairs{0, -1, 0 / 0} do try('cycle ' .. text(cycle):gsub('-?nan', 'nan'), pos, 1, cycle, -1, {0, 0, 0}, {0.5, 1, 10}, {1}, {1, 0}) end

-- Refused when asked for a step: a velocity at the end, or limits, that cannot be.
try('beyond the limit', step, pos(1, CYCLE, 0, {0, 0, 0}, {0.5, 1, 10}, {1}, {1, 2}), 0.05)
try('no speed', step, pos(1, CYCLE, 0, {0, 0, 0}, {0, 1, 10}, {1}, {1, 0}), 0.05)
try('too fast at the start', step, pos(1, CYCLE, 0, {0, 2, 0}, {0.5, 1, 10}, {1}, {1, 0}), 0.05)
try('huge', function() return (step(pos(1, CYCLE, 0, {-1e300, 0, 0}, {1e300, 1e300, 1e300}, {1}, {1e300, 0}), 0.05)) end)
try('tiny', step, pos(1, CYCLE, 0, {0, 0, 0}, {1e-300, 1e-300, 1e-300}, {1}, {1, 0}), 0.05)
try('there', step, pos(1, CYCLE, 0, {1, 0, 0}, {0.5, 1, 10}, {1}, {1, 0}), 0.05)

-- M1: the end, and what comes after it.
local h = pos(1, CYCLE, 0, {0, 0, 0}, {0.5, 1, 10}, {1}, {0.97, 0})
local result, state, sync, steps = 0, nil, nil, 0
while result == 0 do
    result, state, sync = step(h, 0.05)
    steps = steps + 1
end
try('end', function() return steps, result, state, sync end)
try('after the end', step, h, 0.05)
try('not a multiple', step, h, 0.00005)
try('backwards', step, h, -0.05)
try('float for a handle', step, h + 0.0, 0.05)

-- Legacy flag 2 is phase synchronisation, -1 that of time, 3 none. Two axes, one with half the way and the same limits.
for _, flags in ipairs{sim.ruckig_phasesync, 2, sim.ruckig_timesync, -1, sim.ruckig_nosync} do
    local two = pos(2, CYCLE, flags, {0, 0, 0, 0, 0, 0}, {0.5, 0.5, 1, 1, 10, 10}, {1, 1}, {1, 0.5, 0, 0})
    local _, p, left = step(two, 1)
    try('flags ' .. flags, function() return p[1], math.abs(p[2] - p[1] / 2) < 1e-9, left end)
end
local asymmetric = sim.ruckig_minvel | sim.ruckig_minaccel
local down = pos(1, CYCLE, asymmetric, {0, 0, 0}, {0.5, 1, 10, -0.2, -0.5}, {1}, {-1, 0})
try('minima', step, down, 2)
local one = pos(2, CYCLE, 0, {0, 7, 0, 0, 0, 0}, {0.5, 0.5, 1, 1, 10, 10}, {1, 0}, {1, 1, 0, 0})
try('one of two', step, one, 1)
-- M2: 1.1 s to 1 m/s, 0.55 m.
try('velocity', step, vel(1, CYCLE, -1, {0, 0, 0}, {1, 10}, {1}, {1}), 1.1)
try('less acceleration down', step, vel(1, CYCLE, sim.ruckig_minaccel, {0, 1, 0}, {1, 10, -0.5}, {1}, {0}), 1)

try('unknown', step, 99999, 0.05)
try('removed', sim.ruckigRemove, h)
try('removed twice', sim.ruckigRemove, h)
try('step of a removed one', step, h, 0.05)

local old = sim.rmlPos(1, CYCLE, -1, {0, 0, 0}, {0.5, 1, 10}, {1}, {1, 0})
try('rml', sim.rmlStep, old, 0.05)
try('rml velocity', sim.rmlStep, sim.rmlVel(1, CYCLE, -1, {0, 0, 0}, {1, 10}, {1}, {1}), 0.05)
try('rml removed', sim.rmlRemove, old)
try('global names', function() return simRMLPos ~= nil, simRMLVel ~= nil, simRMLStep ~= nil, simRMLRemove ~= nil end)
