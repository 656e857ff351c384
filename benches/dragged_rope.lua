-- A rope of LINKS links on ball joints lies on a table, and a force at one end drags it to and fro: links slide, hold and roll. Prints the milliseconds of a step of
-- 50 ms: median and longest. FORM is capsule, cylinder or cuboid.
--
--     swanilda run benches/dragged_rope.lua --empty --no-start --loops 1000000 -D links=20 -D form=capsule
sim = require 'sim'

local STEPS <const>, LENGTH <const>, THICKNESS <const>, MASS <const>, FORCE <const> = 100, 0.03, 0.012, 0.005, 0.3
local LINKS <const> = tonumber(sim.getNamedStringParam('links') or 20)
local FORM <const> = sim['primitiveshape_' .. (sim.getNamedStringParam('form') or 'capsule')]

local function solid(form, size, at)
    local shape = sim.createPrimitiveShape(form, size)
    sim.setObjectPosition(shape, at)
    sim.setBoolProperty(shape, 'respondable', true)
    return shape
end

--- Link number i, whose neighbours it does not touch.
local function link(i)
    local length = FORM == sim.primitiveshape_capsule and LENGTH or 0.9 * LENGTH
    local shape = solid(FORM, {THICKNESS, THICKNESS, length}, {LENGTH * (i - LINKS / 2), 0, THICKNESS / 2 + 0.002})
    sim.setObjectOrientation(shape, {0, math.pi / 2, 0})
    sim.setBoolProperty(shape, 'dynamic', true)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable_mask, i % 2 == 1 and 0xff01 or 0xff02)
    sim.setShapeMass(shape, MASS)
    return shape
end

local function join(first, second)
    local joint = sim.createJoint(sim.joint_spherical, sim.jointmode_dynamic, 0)
    local place = sim.getObjectPosition(second)
    sim.setObjectPosition(joint, {place[1] - LENGTH / 2, place[2], place[3]})
    sim.setObjectParent(joint, first, true)
    sim.setObjectParent(second, joint, true)
end

function sysCall_thread()
    solid(sim.primitiveshape_cuboid, {2, 2, 0.1}, {0, 0, -0.05})
    local head = link(1)
    local last = head
    for i = 2, LINKS do
        local next = link(i)
        join(last, next)
        last = next
    end
    sim.setStepping(true)
    sim.startSimulation()
    local times = {}
    for i = 1, STEPS do
        sim.addForceAndTorque(head, {0, FORCE * math.sin(i / 10), 0}, {0, 0, 0})
        local start = sim.getSystemTime()
        sim.step()
        times[i] = 1000 * (sim.getSystemTime() - start)
    end
    table.sort(times)
    print(string.format('%d links: median %.2f, longest %.2f ms', LINKS, times[STEPS // 2], times[STEPS]))
    sim.quitSimulator()
end
