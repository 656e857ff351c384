-- Each callback of the physics takes the scene apart while the physics runs, in every way there is.
sim = require 'sim'
watch = require 'watch'

local deeds = {
    function(o) sim.removeObjects({o.tip}) end,
    function(o) sim.removeObjects({o.joint}) end,
    function(o) sim.removeObjects({o.sensor}) end,
    function(o) sim.removeObjects({o.base}) end,
    function(o) sim.removeModel(o.base) end,
    function(o) sim.removeObjects(sim.getObjectsInTree(o.base)) end,
    function(o) sim.setObjectParent(o.tip, -1, true) end,
    function(o) sim.setObjectParent(o.tip, o.free, false) end,
    function(o) sim.setJointMode(o.joint, sim.jointmode_kinematic, 0) end,
    function(o) sim.setJointMode(o.joint, sim.jointmode_dependent, 0) end,
    function(o) sim.setObjectInt32Param(o.joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity) end,
    function(o) sim.setJointInterval(o.joint, false, {0 / 0, 1 / 0}) end,
    function(o) sim.setObjectPosition(o.tip, {1, 1, 1}) sim.resetDynamicObject(o.tip) end,
    function(o) sim.setObjectInt32Param(o.tip, sim.shapeintparam_static, 1) end,
    function(o) sim.setShapeMass(o.free, 1e9) end,
    function(o) sim.scaleObjects({o.base, o.joint, o.tip}, 2, false) end,
    function(o) sim.handleDynamics(0.05) end,
    function(o) sim.groupShapes({o.free, o.tip}) end,
    function(o) sim.setBoolParam(sim.boolparam_dynamics_handling_enabled, false) end,
    function(o) sim.setArrayParam(sim.arrayparam_gravity, {0, 0, 0 / 0}) end,
    function(o) sim.stopSimulation() end,
    function(o) sim.pauseSimulation() sim.startSimulation() end,
    function(o) error('broken') end,
}
local moments = {'dynBefore', 'dynAfter', 'joint', 'contact', 'trigger'}

-- Force sensors and joints tell only the scripts on them.
local function attach(object, callback, returns)
    local code = "sim = require 'sim' function sysCall_%s() sim.callScriptFunction('act', %d, '%s') return %s end"
    local me = sim.getScript(sim.handle_self)
    local script = sim.createScript(sim.scripttype_simulation, code:format(callback, me, callback, returns), 0, 'lua')
    sim.setObjectParent(script, object, false)
    sim.initScript(script)
end

local function build()
    local o = {}
    o.floor = watch.box('floor', {0, 0, -0.05}, false, true)
    o.base = watch.box('base', {0, 0, 1}, false, false)
    o.link, o.tip = watch.box('link', {0.2, 0, 1}, true, true), watch.box('tip', {0.4, 0, 1}, true, true)
    -- Any force is too much for it.
    o.sensor = watch.link(sim.createForceSensor(1, {0, 1, 1, 0, 0}, {0.05, 1e-9, 10, 0, 0}), o.base, o.link)
    attach(o.sensor, 'trigger', '')
    o.joint = watch.link(watch.joint(sim.joint_revolute, sim.jointdynctrl_callback), o.link, o.tip)
    attach(o.joint, 'joint', '{velocity = 1, force = 1}')
    o.free = watch.box('free', {0, 0, 0.05}, true, true)
    return o
end

local turn, objects, done, acted = 0, nil, true, 0

function act(moment)
    if moments[turn % #moments + 1] ~= moment or done then return end
    done = true
    acted = acted + 1
    pcall(deeds[turn // #moments + 1], objects)
end

function sysCall_dyn(data) act(data.afterStep and 'dynAfter' or 'dynBefore') end
function sysCall_contact(data) act('contact') end

local function clear()
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        if object ~= sim.getObject('.') then pcall(sim.removeObjects, {object}) end
    end
    sim.setBoolParam(sim.boolparam_dynamics_handling_enabled, true)
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, -9.81})
end

local step = 0
function sysCall_actuation()
    step = step + 1
    if step % 3 == 1 then
        turn = step // 3
        if turn >= #deeds * #moments then return sim.stopSimulation() end
        clear()
        objects, done = build(), false
    end
end

function sysCall_sensing() watch.check() end

-- A deed that ends the simulation does not end the test.
function sysCall_nonSimulation()
    if turn < #deeds * #moments then sim.startSimulation() else print('all is well', acted, 'of', #deeds * #moments, 'moments came') sim.quitSimulator() end
end

function sysCall_suspended() sim.startSimulation() end
