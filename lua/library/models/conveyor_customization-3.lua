--[[
Script of straight conveyors with pads or rollers: `conveyor = require('models.conveyor_customization-3')` in a script of a model that is a closed path with 18
control points (spec: models 5). Settings are those of configUi; scripts drive it by custom data: `__ctrl__` {vel=} or {pos=}, `__state__` {pos, vel}.
]]

local sim = _quietRequire 'sim'
local path = require 'models.path_customization-2'
require 'configUi'
local belt = require 'swanilda.conveyors.belt'
local control = require 'swanilda.conveyors.control'
local parts = require 'swanilda.conveyors.parts'

local conveyor = {}
_S.conveyor = conveyor

local FINGERPRINT <const> = '__fingerPrint__'
local FIRST <const> = {
    type = 1, length = 1, width = 0.2, radius = 0.1, color = {0.2, 0.2, 0.2}, frameColor = {0.5, 0.5, 0.5}, respondable = true,
    rollerCnt = 16, beltElementWidth = 0.05, beltElementThickness = 0.005, beltElementSpacing = 0.002, targetVel = 0.1, accel = 0.01,
}

local function isBelt(_, config) return config.type == 1 end

local function isRoller(_, config) return config.type == 2 end

local SCHEMA <const> = {
    type = {name = 'Type', choices = {'Belt', 'Roller'}, default = 1, ui = {control = 'radio', order = 1, tab = 'General'}},
    length = {name = 'Length', type = 'float', default = 1, minimum = 0.01, maximum = 5, ui = {order = 2, tab = 'General'}},
    width = {name = 'Width', type = 'float', default = 0.2, minimum = 0.01, maximum = 5, ui = {order = 3, tab = 'General'}},
    radius = {name = 'Radius', type = 'float', default = 0.1, minimum = 0.01, maximum = 0.5, ui = {order = 4, tab = 'General'}},
    color = {name = 'Colour', type = 'color', default = {0.2, 0.2, 0.2}, ui = {order = 5, tab = 'General'}},
    frameColor = {name = 'Colour of the frame', type = 'color', default = {0.5, 0.5, 0.5}, ui = {order = 6, tab = 'General'}},
    respondable = {name = 'Respondable', type = 'bool', default = true, ui = {order = 7, tab = 'General'}},
    targetVel = {name = 'Target velocity', type = 'float', default = 0.1, minimum = -5, maximum = 5, ui = {order = 8, tab = 'General'}},
    accel = {name = 'Acceleration', type = 'float', default = 0.01, minimum = 0.001, maximum = 100, ui = {order = 9, tab = 'General'}},
    rollerCnt = {name = 'Rollers', type = 'int', default = 8, minimum = 2, maximum = 50, ui = {order = 1, tab = 'Rollers', enabled = isRoller}},
    beltElementWidth = {
        name = 'Width of pads', type = 'float', default = 0.05, minimum = 0.005, maximum = 0.5, ui = {order = 1, tab = 'Belt', enabled = isBelt},
    },
    beltElementThickness = {
        name = 'Thickness of pads', type = 'float', default = 0.005, minimum = 0.001, maximum = 0.1, ui = {order = 2, tab = 'Belt', enabled = isBelt},
    },
    beltElementSpacing = {
        name = 'Spacing of pads', type = 'float', default = 0.01, minimum = 0, maximum = 0.5, ui = {order = 3, tab = 'Belt', enabled = isBelt},
    },
}

function path.shaping(_, isClosed)
    local config = conveyor.config
    return isClosed and config and belt.frame(belt.polygon(path), (belt.geometry(config)), config.width, config)
end

--- Makes the conveyor with these settings; it stands at 0 and runs with their velocity.
function conveyor.init2(config)
    conveyor.config = config
    local radius, depth = belt.geometry(config)
    local isNew = not parts.isMadeWith(conveyor.model, FINGERPRINT, config)
    if isNew then
        path.setPathShape(-1)
        belt.place(path, belt.controlPoses(config.length, radius, depth))
        path.forceFullRebuild = true
    end
    path.setup()
    conveyor.setPathPos = belt.build(path, config, belt.polygon(path), depth, isNew)
    parts.noteSettings(conveyor.model, FINGERPRINT, config)
    conveyor.drive = conveyor.drive or control.drive(conveyor.model, function(pos) conveyor.setPathPos(pos) end)
    conveyor.drive:restart(config)
    conveyor.setPathPos(0)
end

--- Finds the model. It is made with the settings in the next pass.
function conveyor.init()
    path.init()
    conveyor.model = path.model
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

function sysCall_afterSimulation()
    path.afterSimulation()
    conveyor.afterSimulation()
end

local configUi = ConfigUI('Conveyor', SCHEMA, function(config) conveyor.init2(config) end)

function configUi.getObjectCallback() return path.model end

return conveyor
