-- as: sandbox
-- passes: 0
-- spec: paths 1; quaternions in configurations: the shortest arc, whatever their signs and lengths
-- tol: 1e-9
-- topic: motion
sim = require 'sim'

local TYPES <const> = {2, 2, 2, 2}

local function about(axis, angle, factor)
    local s, c = math.sin(angle / 2), math.cos(angle / 2)
    local q = {axis[1] * s, axis[2] * s, axis[3] * s, c}
    for i = 1, 4 do q[i] = q[i] * (factor or 1) end
    return q
end

local function show(what, q)
    local t = {}
    for i, x in ipairs(q) do t[i] = string.format('%.10f', math.abs(x) < 5e-11 and 0.0 or x) end
    print(what, table.concat(t, ' '))
end

local function between(a, b, t)
    local path = table.move(b, 1, 4, 5, table.move(a, 1, 4, 1, {}))
    return sim.getPathInterpolatedConfig(path, {0, 1}, t, nil, TYPES)
end

local X <const>, Z <const>, D <const> = {1, 0, 0}, {0, 0, 1}, {0.48, 0.6, 0.64}
for _, t in ipairs{0.1, 0.25, 0.5, 0.75} do
    show('0 to 1.2 about z, ' .. t, between(about(Z, 0), about(Z, 1.2), t))
    show('the same, other sign, ' .. t, between(about(Z, 0), about(Z, 1.2, -1), t))
    show('0.3 to -0.5 about a diagonal, ' .. t, between(about(D, 0.3), about(D, -0.5), t))
    show('the long way is not taken, ' .. t, between(about(X, 0.2), about(X, 4.2), t))
    show('next to nothing, ' .. t, between(about(X, 1), about(X, 1.0008), t))
end
show('other axes', between(about(X, 1), about(Z, 1), 0.5))

local function distance(what, a, b, metric) print(what, string.format('%.10f', sim.getConfigDistance(a, b, metric, TYPES))) end
distance('angle', about(D, 0.3), about(D, 1.7))
distance('angle, other sign', about(D, 0.3), about(D, 1.7, -1))
distance('more than half a turn', about(D, 0.2), about(D, 4.2))
distance('half a turn', about(X, 0), about(X, math.pi))
distance('tiny', about(X, 1), about(X, 1 + 1e-6), {1e6, 5, 5, 5})
distance('twice as long', about(Z, 0.5, 2), about(Z, 0.9, 2))
distance('the same', about(Z, 0.5), about(Z, 0.5))
distance('nothing', {0, 0, 0, 0}, about(Z, 0.5))
show('inverse', sim.getQuaternionInverse(about(D, 1)))
