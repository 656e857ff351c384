--[[
Script of conveyors that are one box, whose surface moves what lies on it: `conveyor = require('models.efficientConveyor_customization-3')` in a script of a model
with the shapes `forwarder`, `visible1` and `visible2` (spec: models 5). Driven as the other conveyors, by `__ctrl__` and `__state__`.
]]

local sim = _quietRequire 'sim'
require 'configUi'
local control = require 'swanilda.conveyors.control'
local parts = require 'swanilda.conveyors.parts'

local conveyor = {}
_S.conveyor = conveyor

local LARGER <const>, LOWER <const> = 0.005, 0.0025 -- m: the second visible box
local FIRST <const> = {
    length = 1, width = 0.2, height = 0.1, color = {0.2, 0.2, 0.2}, frameColor = {0.5, 0.5, 0.5}, targetVel = 0.1, accel = 0.01,
}

local function float(name, default, minimum, maximum, order)
    return {name = name, type = 'float', default = default, minimum = minimum, maximum = maximum, ui = {order = order}}
end

local SCHEMA <const> = {
    length = float('Length', 1, 0.01, 5, 1), width = float('Width', 0.2, 0.01, 5, 2), height = float('Height', 0.1, 0.01, 5, 3),
    color = {name = 'Colour', type = 'color', default = {0.2, 0.2, 0.2}, ui = {order = 4}},
    frameColor = {name = 'Colour of the frame', type = 'color', default = {0.5, 0.5, 0.5}, ui = {order = 5}},
    targetVel = float('Target velocity', 0.1, -5, 5, 6), accel = float('Acceleration', 0.01, 0.001, 100, 7),
}

local function owner()
    local object = sim.getObject('.')
    local isScript = sim.getObjectType(object) == sim.sceneobject_script
    return isScript and sim.getObjectParent(object) or object
end

local function child(name) return sim.getObject('./' .. name, {proxy = conveyor.model}) end

local function resize(shape, sizes, z)
    local now = sim.getShapeBB(shape)
    local scale = {}
    for i = 1, 3 do scale[i] = now[i] > 0 and sizes[i] / now[i] or 1 end
    sim.scaleObject(shape, scale[1], scale[2], scale[3])
    sim.setObjectPose(shape, {0, 0, z, 0, 0, 0, 1}, conveyor.model)
end

local function paint(shape, colour) sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, parts.colour(colour)) end

-- The surface moves by the initial velocity of a body that does not.
local function push(_, speed)
    local pose = sim.getObjectPose(conveyor.forwarder)
    local along = sim.multiplyPoses({0, 0, 0, pose[4], pose[5], pose[6], pose[7]}, {speed, 0, 0, 0, 0, 0, 1})
    sim.resetDynamicObject(conveyor.forwarder)
    for i, axis in ipairs{'x', 'y', 'z'} do
        sim.setObjectFloatParam(conveyor.forwarder, sim['shapefloatparam_init_velocity_' .. axis], along[i])
    end
end

function conveyor.init2(config)
    conveyor.config = config
    conveyor.forwarder, conveyor.visible1, conveyor.visible2 = child('forwarder'), child('visible1'), child('visible2')
    local sizes = {config.length, config.width, config.height}
    resize(conveyor.forwarder, sizes, -config.height / 2)
    resize(conveyor.visible1, sizes, -config.height / 2)
    resize(conveyor.visible2, {sizes[1] + LARGER, sizes[2] + LARGER, sizes[3] + LARGER}, -config.height / 2 - LOWER)
    paint(conveyor.visible1, config.color)
    paint(conveyor.visible2, config.frameColor)
    conveyor.drive = conveyor.drive or control.drive(conveyor.model, push)
    conveyor.drive:restart(config)
end

--- Finds the model. It is made with the settings in the next pass.
function conveyor.init()
    conveyor.model = owner()
    if next(sim.readCustomTableData(conveyor.model, '__config__')) == nil then
        sim.writeCustomTableData(conveyor.model, '__config__', FIRST)
    end
    control.describe(conveyor.model)
end

function conveyor.actuation()
    if conveyor.drive then conveyor.drive:actuation() end
end

function conveyor.afterSimulation()
    if conveyor.drive then conveyor.drive:afterSimulation(conveyor.config) end
end

function sysCall_init() conveyor.init() end

function sysCall_actuation() conveyor.actuation() end

function sysCall_afterSimulation() conveyor.afterSimulation() end

local configUi = ConfigUI('EfficientConveyor', SCHEMA, function(config) conveyor.init2(config) end)

function configUi.getObjectCallback() return owner() end

return conveyor
