-- Several hundred steps of random edits of a running scene.
sim = require 'sim'
watch = require 'watch'

local shapes, joints, sensors, dummies = {}, {}, {}, {}
local function any(list) return #list > 0 and list[math.random(#list)] or -1 end
local function number()
    local odd = {0, -1, 1, 1e-9, 1e9, 1e200, -1e300, 0 / 0, 1 / 0}
    return math.random() < 0.3 and odd[math.random(#odd)] or math.random() * 4 - 2
end
local function point() return {math.random() * 2 - 1, math.random() * 2 - 1, math.random()} end
local function odd() return {number(), number(), number()} end
local function anything() return any(({shapes, joints, sensors, dummies})[math.random(4)]) end
local function forget(list)
    for i = #list, 1, -1 do
        if not sim.isHandle(list[i]) then table.remove(list, i) end
    end
end

local edits = {
    function() shapes[#shapes + 1] = watch.box('s', point(), math.random() < 0.7, math.random() < 0.8) end,
    function() joints[#joints + 1] = watch.joint(({10, 11, 12})[math.random(3)], ({0, 1, 4, 8, 12, 16})[math.random(6)]) end,
    function() sensors[#sensors + 1] = watch.sensor() end,
    function() dummies[#dummies + 1] = sim.createDummy(0.01) sim.setObjectInt32Param(dummies[#dummies], 10000, 0) end,
    function() watch.link(any(math.random() < 0.7 and joints or sensors), any(shapes), any(shapes)) end,
    function() watch.link(any(math.random() < 0.7 and joints or sensors), any(shapes), any(shapes)) end,
    function() sim.setObjectParent(anything(), anything(), math.random() < 0.5) end,
    function() sim.setLinkDummy(any(dummies), any(dummies)) end,
    function() sim.removeObjects({anything()}) end,
    function() sim.setJointMode(any(joints), ({0, 4, 5, 5, 5})[math.random(5)], 0) end,
    function() sim.setObjectInt32Param(any(joints), 2039, ({0, 1, 4, 8, 12, 16})[math.random(6)]) end,
    function() sim.setJointDependency(any(joints), any(joints), number(), number()) end,
    function() sim.setJointInterval(any(joints), math.random() < 0.3, {number(), number()}) end,
    function() sim.setJointTargetPosition(any(joints), number()) end,
    function() sim.setJointTargetVelocity(any(joints), number()) end,
    function() sim.setJointTargetForce(any(joints), number()) end,
    function() sim.setJointPosition(any(joints), number()) end,
    function() sim.setObjectFloatParam(any(joints), ({2018, 2019, 2036, 2037, 2038, 2042})[math.random(6)], number()) end,
    function() sim.addForceAndTorque(any(shapes), odd(), odd()) end,
    function() sim.addForce(any(shapes), odd(), odd()) end,
    function() sim.setShapeMass(any(shapes), number()) end,
    function() sim.setShapeInertia(any(shapes), {number(), 0, 0, 0, number(), 0, 0, 0, number()}, {1, 0, 0, number(), 0, 1, 0, 0, 0, 0, 1, 0}) end,
    function() sim.setObjectInt32Param(any(shapes), sim.shapeintparam_static, math.random(0, 1)) end,
    function() sim.setObjectInt32Param(any(shapes), sim.shapeintparam_respondable, math.random(0, 1)) end,
    function() sim.setObjectInt32Param(any(shapes), sim.shapeintparam_respondable_mask, math.random(0, 0xffff)) end,
    function() sim.setObjectFloatParam(any(shapes), 3000 + math.random(0, 2), number()) end,
    function() sim.setObjectFloatParam(any(shapes), 3020 + math.random(0, 2), number()) end,
    function() sim.setObjectPosition(anything(), math.random() < 0.8 and point() or odd()) end,
    function() sim.setModelProperty(any(shapes), math.random(0, 0xff)) end,
    function() sim.resetDynamicObject(any(shapes)) end,
    function() sim.scaleObjects({anything()}, number(), false) end,
}

function sysCall_init()
    math.randomseed(SEED or 9)
    local floor = watch.box('floor', {0, 0, -0.05}, false, true)
    sim.scaleObject(floor, 100, 100, 1)
end

local done = 0

local function edit(count)
    for _ = 1, count do
        if pcall(edits[math.random(#edits)]) then done = done + 1 end
    end
    for _, list in ipairs{shapes, joints, sensors, dummies} do
        forget(list)
        while #list > 12 do sim.removeObjects({table.remove(list, 1)}) end
    end
end

function sysCall_actuation() edit(8) end
function sysCall_dyn(data) if math.random() < 0.05 then edit(1) end end
function sysCall_joint() if math.random() < 0.05 then edit(1) end return {velocity = number(), force = number()} end
function sysCall_contact() if math.random() < 0.02 then edit(1) end end
function sysCall_sensing() watch.check() end
function sysCall_afterSimulation() print('all is well', done, 'edits done') end
