-- A cart that balances a pole: linear state feedback on a driven joint.
--
--     swanilda run scenes/inverted_pendulum.lua
--
--         pole, 1 m, free to swing about y
--          |
--       [cart]            prismatic joint along x, velocity controlled
--     ============ rail

sim = require 'sim'

local HALF_LENGTH = 0.5 -- of the pole, metres
local START_ANGLE = math.rad(6)
local PUSH_TIME, PUSH = 4, {1.5, 0, 0} -- seconds, newtons for one step

local function link(alias, size, position, mass, parent)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectAlias(h, alias)
    sim.setObjectPosition(h, position)
    sim.setShapeMass(h, mass)
    if parent then sim.setObjectParent(h, parent, true) end
    return h
end

local function joint(kind, alias, position, euler, parent)
    local h = sim.createJoint(kind, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(h, alias)
    sim.setObjectPosition(h, position)
    sim.setObjectOrientation(h, euler)
    sim.setObjectParent(h, parent, true)
    return h
end

local function build()
    local rail = link('Rail', {4, 0.05, 0.05}, {0, 0, 1}, 10)
    slider = joint(sim.joint_prismatic, 'Slider', {0, 0, 1}, {0, math.pi / 2, 0}, rail)
    sim.setJointInterval(slider, false, {-2, 4})
    sim.setIntProperty(slider, 'dynCtrlMode', sim.jointdynctrl_velocity)
    sim.setJointTargetForce(slider, 500)
    sim.setJointTargetVelocity(slider, 0)

    local cart = link('Cart', {0.3, 0.2, 0.1}, {0, 0, 1}, 1, slider)
    sim.setBoolProperty(cart, 'dynamic', true)

    hinge = joint(sim.joint_revolute, 'Hinge', {0, 0, 1}, {-math.pi / 2, 0, 0}, cart)
    local s, c = math.sin(START_ANGLE), math.cos(START_ANGLE)
    pole = link('Pole', {0.03, 0.03, 2 * HALF_LENGTH}, {HALF_LENGTH * s, 0, 1 + HALF_LENGTH * c}, 0.2)
    sim.setObjectOrientation(pole, {0, START_ANGLE, 0})
    sim.setObjectParent(pole, hinge, true)
    sim.setBoolProperty(pole, 'dynamic', true)
end

-- The controller is a child script of the cart's joint, as it would be in a model.
local CONTROLLER = [[
sim = require 'sim'

function sysCall_init()
    slider = sim.getObject('..')
    pole = sim.getObject('../Pole')
    -- Gains that put the poles of the closed loop at -2, -2, -3 and -3 1/s (uniform pole of 1 m, g = 9.81 m/s2).
    gain = {angle = 36.1, rate = 9.38, position = 2.45, velocity = 4.08}
end

-- Lean of the pole to +x, radians.
local function lean()
    local m = sim.getObjectMatrix(pole)
    return math.atan(m[3], m[11])
end

function sysCall_actuation()
    local dt = sim.getSimulationTimeStep()
    local angle = lean()
    local rate = (angle - (lastAngle or angle)) / dt
    lastAngle = angle
    local x, v = sim.getJointPosition(slider), sim.getJointVelocity(slider)
    local acceleration = gain.angle * angle + gain.rate * rate + gain.position * x + gain.velocity * v
    sim.setJointTargetVelocity(slider, v + acceleration * dt)
end

-- Called by the scene's script.
function state() return lean(), sim.getJointPosition(slider) end
]]

function sysCall_init()
    build()
    controller = sim.createScript(sim.scripttype_simulation, CONTROLLER)
    sim.setObjectAlias(controller, 'Controller')
    sim.setObjectParent(controller, slider, false)
end

function sysCall_actuation()
    local t = sim.getSimulationTime()
    if math.abs(t - PUSH_TIME) < 1e-6 then
        print('           somebody pushes the pole')
        sim.addForceAndTorque(pole, PUSH)
    end
end

function sysCall_sensing()
    local t = sim.getSimulationTime()
    if (t + 1e-6) % 1 < 2e-6 then
        angle, x = sim.callScriptFunction('state', controller)
        print(string.format('t = %4.1f s   pole %6.2f deg   cart %6.3f m', t, math.deg(angle), x))
    end
    if t >= 10 and not done then
        done = true
        print(math.abs(angle) < math.rad(2) and 'The pole stands.' or 'The pole has fallen.')
        sim.stopSimulation()
    end
end
