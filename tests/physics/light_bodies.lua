-- A torque turns a body as its moment of inertia says: from 1 mg to 1 t, whatever the shape and the axis, also of shapes that collide, and of groups.
local bench = require 'lib.bench'

bench.gravity(0)
local MASSES <const> = {1e-6, 1e-4, 1e-2, 1, 1000}
-- Size in metres; moments of inertia per unit of mass.
local function box(x, y, z) return {'cuboid', {x, y, z}, {(y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12}} end
local function rod(radius, length)
    local across = (3 * radius * radius + length * length) / 12
    return {'cylinder', {2 * radius, 2 * radius, length}, {across, across, radius * radius / 2}}
end
local SHAPES <const> = {
    pen = box(0.01, 0.02, 0.08), ['plate across x'] = box(0.001, 0.1, 0.1), ['plate across y'] = box(0.1, 0.001, 0.1),
    cube = box(0.05, 0.05, 0.05), coin = rod(0.01, 0.002), stick = rod(0.002, 0.1),
}
local NAMES <const> = {'pen', 'plate across x', 'plate across y', 'cube', 'coin', 'stick'}

local bodies = {}
for index, name in ipairs(NAMES) do
    local kind, size, moments = table.unpack(SHAPES[name])
    for m, mass in ipairs(MASSES) do
        for axis = 1, 3 do
            local at = {2 * index, 2 * m, 2 * axis}
            local body = bench.body{kind = sim['primitiveshape_' .. kind], size = size, at = at, mass = mass, solid = true}
            bodies[#bodies + 1] = {name = name, mass = mass, axis = axis, body = body, moment = mass * moments[axis]}
        end
    end
end

-- Groups of parts, with the moments of a pen.
local function group(count, at, mass, turn)
    local parts = {}
    for i = 1, count do
        parts[i] = bench.body{size = {0.01, 0.02, 0.02}, at = {0.02 * i, 0.01 * i * i, 0.01 * i}, turn = {turn * i, 2 * turn * i, turn}}
    end
    local body = sim.groupShapes(parts)
    sim.relocateShapeFrame(body, {0, 0, 0, 0, 0, 0, 1})
    sim.setObjectPosition(body, at)
    sim.setShapeMass(body, mass)
    local moments = SHAPES.pen[3]
    sim.setShapeInertia(body, {mass * moments[1], 0, 0, 0, mass * moments[2], 0, 0, 0, mass * moments[3]}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})
    sim.setBoolProperty(body, 'dynamic', true)
    sim.setBoolProperty(body, 'respondable', true)
    return body
end
-- Number of parts, and by how much they are turned.
for _, parts in ipairs{{2, 0}, {3, 0}, {4, 0}, {2, 0.3}, {4, 0.3}} do
    local count, turn = table.unpack(parts)
    local name = (turn > 0 and 'group of %d turned parts' or 'group of %d'):format(count)
    NAMES[#NAMES + 1] = name
    for m, mass in ipairs(MASSES) do
        for axis = 1, 3 do
            local body = group(count, {2 * (#NAMES + 10), 2 * m, 2 * axis}, mass, turn)
            bodies[#bodies + 1] = {name = name, mass = mass, axis = axis, body = body, moment = mass * SHAPES.pen[3][axis]}
        end
    end
end

-- The same bodies, in an inclined frame: their inertia has products.
local tilted = {}
for index, mass in ipairs(MASSES) do
    local body = bench.body{size = {0.01, 0.02, 0.08}, at = {20, 2 * index, 0}, turn = {0.3, 0.5, 0.7}, mass = mass}
    sim.relocateShapeFrame(body, {0, 0, 0, 0, 0, 0, 1})
    tilted[index] = {mass = mass, body = body}
end
local TURN <const> = sim.buildMatrix({0, 0, 0}, {0.3, 0.5, 0.7})
local LONG <const> = {TURN[3], TURN[7], TURN[11]} -- of the pen, in the world

local SECONDS <const> = 0.5

local function torqueOf(moment, direction)
    local torque = {}
    for k = 1, 3 do torque[k] = moment * direction[k] end -- 1 rad/s2
    return torque
end

bench.run(function()
    local long = (0.01 ^ 2 + 0.02 ^ 2) / 12
    while sim.getSimulationTime() < SECONDS - 1e-6 do
        for _, it in ipairs(bodies) do
            local direction = {0, 0, 0}
            direction[it.axis] = 1
            sim.addForceAndTorque(it.body, {0, 0, 0}, torqueOf(it.moment, direction))
        end
        for _, it in ipairs(tilted) do sim.addForceAndTorque(it.body, {0, 0, 0}, torqueOf(long * it.mass, LONG)) end
        sim.step()
    end
    local t = sim.getSimulationTime()
    for _, name in ipairs(NAMES) do
        for axis = 1, 3 do
            local worst = 1
            for _, it in ipairs(bodies) do
                if it.name == name and it.axis == axis then
                    local _, w = sim.getVelocity(it.body)
                    local turned = w[axis] / t
                    if math.abs(turned - 1) >= math.abs(worst - 1) then worst = turned end
                end
            end
            bench.check(name .. ' about ' .. ('xyz'):sub(axis, axis) .. ', any mass: angular acceleration, rad/s2', worst, 1, 1e-3)
        end
    end
    for _, it in ipairs(tilted) do
        local _, w = sim.getVelocity(it.body)
        local along = (w[1] * LONG[1] + w[2] * LONG[2] + w[3] * LONG[3]) / t
        bench.check(string.format('pen of %g kg in an inclined frame, about its length, rad/s2', it.mass), along, 1, 1e-3)
    end
end)
