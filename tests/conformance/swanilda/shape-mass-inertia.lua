-- as: simulation
-- passes: 8
-- engine: bullet278
-- spec: shapes 6; inertia is kept per kilogram: another mass scales it; setShapeInertia in its own frame; what a torque makes of it
-- tol: 1e-6
-- topic: shapes
sim = require 'sim'

local function box(x, mass)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3})
    sim.setObjectPosition(shape, {x, 0, 1})
    if mass then sim.setShapeMass(shape, mass) end
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    return shape
end

local function show(what, shape)
    local inertia, frame = sim.getShapeInertia(shape)
    local rows = {}
    for i = 1, 9 do rows[i] = string.format('%.6f', inertia[i] + 0.0):gsub('^-0%.0+$', '0.000000') end
    print(what, string.format('%.7f', sim.getShapeMass(shape)), table.concat(rows, ' '))
    print('', string.format('%.6f %.6f %.6f', frame[4], frame[8], frame[12]))
end

local IDENTITY <const> = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}

function sysCall_init()
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, 0})
    local one = box(0)
    print(sim.computeMassAndInertia(one, 1000)) -- 6 kg; m (b2 + c2) / 12 and so on
    show('computed', one)
    sim.setShapeMass(one, 12)
    show('twice the mass', one)
    sim.setShapeMass(one, 0)
    show('the least mass', one)

    turned = box(1, 2)
    -- Axes of the given tensor: x along y of the shape, y against its x; centre of mass aside.
    sim.setShapeInertia(turned, {1, 0, 0, 0, 2, 0, 0, 0, 3}, {0, -1, 0, 0.05, 1, 0, 0, 0.06, 0, 0, 1, 0.07})
    show('turned', turned)
    lower = box(2, 2)
    sim.setShapeInertia(lower, {1, 0.1, 0, 9, 2, 0, 9, 9, 3}, IDENTITY)
    show('upper triangle', lower)
    sim.setShapeMass(lower, 4)
    show('and twice the mass', lower)
end

local steps = 0

function sysCall_actuation()
    steps = steps + 1
    if steps == 1 then sim.addForceAndTorque(turned, {0, 0, 4}, {0, 0, 6}) end
end

function sysCall_sensing()
    if steps ~= 1 then return end
    local v, w = sim.getVelocity(turned)
    -- 4 N at 2 kg, 6 N m at 3 kg m2, for 50 ms: of the centre of mass, about z.
    print(string.format('%.6f %.6f', v[3], w[3]))
end
