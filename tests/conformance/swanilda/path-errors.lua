-- as: sandbox
-- passes: 0
-- spec: paths 1; functions on flat tables: what does not fit, ends, callbacks, closed paths
-- tol: 1e-7
-- topic: motion
sim = require 'sim'
local try = require('lib.trial').try

local P <const>, L <const>, P3 <const> = {0, 0, 1, 0, 1, 1}, {0, 1, 2}, {0, 0, 0, 1, 0, 0, 1, 1, 0}
local nan <const> = 0 / 0
function taxi(a, b) return math.abs(b[1] - a[1]) + math.abs(b[2] - a[2]) end

local lengths = sim.getPathLengths
try('lengths', lengths, {0, 0, 3, 4, 3, 4}, 2)
try('lengths, what is over', lengths, {0, 0, 3, 4, 9}, 2)
try('lengths, poses', lengths, {0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0}, 7)
try('lengths by function', lengths, {0, 0, 3, 4}, 2, taxi)
try('lengths by name', lengths, {0, 0, 3, 4}, 2, 'taxi')
try('lengths by nobody', lengths, {0, 0, 3, 4}, 2, 'nobody')
try('lengths by nothing', lengths, {0, 0, 3, 4}, 2, function() end)
try('lengths by number', lengths, {0, 0, 3, 4}, 2, 5)
for dof = -1, 0 do try('lengths, dof ' .. dof, lengths, {0, 0, 3, 4}, dof) end
try('lengths, a point', lengths, {0, 0}, 2)

local at = sim.getPathInterpolatedConfig
for _, t in ipairs{-5, 0, 1, 2, 99} do try('at ' .. t, at, P, L, t) end
try('at nan', at, P, L, nan)
try('closed', at, P, L, 2 + math.sqrt(0.5), {closed = true})
try('closed Bezier', at, {0, 0, 1, 0, 1, 1, 0, 1}, {0, 1, 2, 3}, 4, {type = 'quadraticBezier', closed = true})
try('closed, forced open', at, {0, 0, 1, 0, 1, 1, 0, 1}, {0, 1, 2, 3}, 4, {type = 'quadraticBezier', closed = true, forceOpen = true})
try('Bezier, least strength', at, P, L, 1, {type = 'quadraticBezier', strength = 0})
try('cyclic', at, {3, -3}, {0, 1}, 0.5, nil, {1})
try('no distance', at, {1, 1, 1, 1}, {0, 0}, 0)
try('quaternions cut off', at, P, L, 1.5, nil, {2, 2})
try('no orientations', at, {0, 0, 0, 0, 0, 0, 0, 0}, {0, 1}, 0.5, nil, {2, 2, 2, 2})
try('more lengths than numbers', at, P, {0, 1, 2, 3, 4, 5, 6}, 1.5)
try('one length', at, P, {0}, 1.5)
try('texts', at, {'a', 'b'}, {0, 1}, 0.5)
try('method', at, P, L, 1, 'linear')

local resample = sim.resamplePath
for _, n in ipairs{-1, 0, 1, 2, 5} do try('resample ' .. n, resample, P, L, n) end
try('resample 2.5', resample, P, L, 2.5)
try('resample too many', resample, P, L, 1000000000)

local closest = sim.getClosestPosOnPath
try('closest', closest, P3, L, {0.25, -1, 0})
try('closest, beyond', closest, P3, L, {2, 5, 0})
try('closest, two segments', closest, P3, L, {0.5, 0.5, 0})
try('closest, poses', closest, {0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 1}, {0, 2}, {1.5, 1, 1})
try('closest, one point', closest, {1, 1, 1}, {0}, {2, 2, 2})
try('closest, flat', closest, P, L, {0, 0, 0})
try('closest, nothing', closest, {}, {}, {0, 0, 0})
try('closest, no point', closest, P3, L, {1, 2})

try('close', sim.closePath, P3, L)
try('close nothing', sim.closePath, {}, {})

local distance = sim.getConfigDistance
try('distance', distance, {0, 0}, {1, 1}, {2, 1})
try('distance, one metric', distance, {0, 0}, {1, 1}, {2})
try('distance, other sizes', distance, {0, 0}, {1})
try('distance, quaternion cut off', distance, {0, 0}, {1, 1}, nil, {2, 2})
try('distance, pose', distance, {0, 0, 0, 0, 0, 0, 1}, {0, 0, 3, 0, 0, 1, 0}, {1, 1, 2, 0.5, 9, 9, 9}, {0, 0, 0, 2, 2, 2, 2})
try('distance, nothing', distance, {}, {})
