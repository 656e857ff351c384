--[[
Script of conveyors along a path: `conveyorSystem = require('models.conveyorSystem_customization-3')` in a script of a path model (spec: models 5). Settings are
those of configUi; scripts drive it by custom data: `__ctrl__` {vel=} or {pos=}, `__state__` {pos, vel}.
]]

local sim = _quietRequire 'sim'
local path = require 'models.path_customization-2'
require 'configUi'
local along = require 'swanilda.conveyors.along'
local control = require 'swanilda.conveyors.control'
local parts = require 'swanilda.conveyors.parts'

local conveyorSystem = {}
_S.conveyorSystem = conveyorSystem

local FINGERPRINT <const>, CLOSED <const>, ROLLERS <const> = '__fingerPrint__', 2, 2
local FIRST <const> = {
    type = 1, width = 0.2, color = {0.2, 0.2, 0.2}, frameColor = {0.5, 0.5, 0.5}, respondable = true, respondableBase = false, closed = false,
    border = true, respondableBorder = true, borderElementLength = 0.05, borderElementHeight = 0.05, borderElementThickness = 0.005,
    beltElementWidth = 0.05, beltElementThickness = 0.005, beltElementSpacing = 0.002, rollerRadius = 0.025, rollerSpacing = 0.01,
    targetVel = 0.1, accel = 0.01,
}

local function isBelt(_, config) return config.type == 1 end

local function isRoller(_, config) return config.type == 2 end

local function hasBorder(_, config) return config.border end

local function float(name, default, minimum, maximum, tab, order, enabled)
    return {
        name = name, type = 'float', default = default, minimum = minimum, maximum = maximum,
        ui = {order = order, tab = tab, enabled = enabled},
    }
end

local function bool(name, default, tab, order) return {name = name, type = 'bool', default = default, ui = {order = order, tab = tab}} end

local SCHEMA <const> = {
    type = {name = 'Type', choices = {'Belt', 'Roller'}, default = 1, ui = {control = 'radio', order = 1, tab = 'General'}},
    width = float('Width', 0.2, 0.01, 5, 'General', 2),
    color = {name = 'Colour', type = 'color', default = {0.2, 0.2, 0.2}, ui = {order = 3, tab = 'General'}},
    frameColor = {name = 'Colour of the frame', type = 'color', default = {0.5, 0.5, 0.5}, ui = {order = 4, tab = 'General'}},
    closed = bool('Closed', false, 'General', 5),
    respondable = bool('Respondable', true, 'General', 6),
    respondableBase = bool('Respondable base', false, 'General', 7),
    targetVel = float('Target velocity', 0.1, 0, 5, 'General', 8),
    accel = float('Acceleration', 0.01, 0.001, 100, 'General', 9),
    beltElementWidth = float('Width of pads', 0.05, 0.005, 0.5, 'Belt', 1, isBelt),
    beltElementThickness = float('Thickness of pads', 0.005, 0.001, 0.1, 'Belt', 2, isBelt),
    beltElementSpacing = float('Spacing of pads', 0.01, 0, 0.5, 'Belt', 3, isBelt),
    rollerRadius = float('Radius', 0.05, 0.001, 0.5, 'Rollers', 1, isRoller),
    rollerSpacing = float('Spacing', 0.01, 0, 0.5, 'Rollers', 2, isRoller),
    border = bool('Border', true, 'Border', 1),
    respondableBorder = bool('Respondable border', true, 'Border', 2),
    borderElementLength = float('Length of elements', 0.05, 0.005, 0.5, 'Border', 3, hasBorder),
    borderElementHeight = float('Height', 0.05, 0.001, 0.5, 'Border', 4, hasBorder),
    borderElementThickness = float('Thickness', 0.005, 0.001, 0.1, 'Border', 5, hasBorder),
}

local function planOf(config)
    return {
        isClosed = path.readInfo().bitCoded & CLOSED ~= 0, width = config.width, useRollers = config.type == ROLLERS,
        pad = {length = config.beltElementWidth, thickness = config.beltElementThickness, spacing = config.beltElementSpacing},
        roller = {radius = config.rollerRadius, spacing = config.rollerSpacing},
        color = parts.colour(config.color), frameColor = parts.colour(config.frameColor),
        respondable = config.respondable, respondableBase = config.respondableBase,
        border = config.border and {
            length = config.borderElementLength, height = config.borderElementHeight, thickness = config.borderElementThickness,
        } or nil,
    }
end

function path.refreshTrigger()
    if not conveyorSystem.config then return end
    conveyorSystem.setPathPos = along.build(path, planOf(conveyorSystem.config))
    conveyorSystem.setPathPos(conveyorSystem.drive and conveyorSystem.drive.pos or 0)
end

--- Makes the conveyor anew if these settings are new; it stands at 0 and runs with their velocity.
function conveyorSystem.gen(config)
    local isNew = not (conveyorSystem.setPathPos and parts.isMadeWith(conveyorSystem.model, FINGERPRINT, config))
    conveyorSystem.config = config
    conveyorSystem.drive = conveyorSystem.drive
        or control.drive(conveyorSystem.model, function(pos) conveyorSystem.setPathPos(pos) end)
    conveyorSystem.drive:restart(config)
    if not isNew then return conveyorSystem.setPathPos(0) end
    local info = path.readInfo()
    info.ctrlPtFixedSize = true
    info.bitCoded = config.closed and info.bitCoded | CLOSED or info.bitCoded & ~CLOSED
    path.writeInfo(info)
    path.forceFullRebuild = true
    path.setup()
    parts.noteSettings(conveyorSystem.model, FINGERPRINT, config)
end

--- Finds the model. It is made with the settings in the next pass.
function conveyorSystem.init()
    path.init()
    conveyorSystem.model = path.model
    if next(sim.readCustomTableData(conveyorSystem.model, '__config__')) == nil then
        sim.writeCustomTableData(conveyorSystem.model, '__config__', FIRST)
    end
    control.describe(conveyorSystem.model)
end

function conveyorSystem.actuation()
    if conveyorSystem.drive then conveyorSystem.drive:actuation() end
end

function sysCall_init() conveyorSystem.init() end

function sysCall_actuation() conveyorSystem.actuation() end

function sysCall_afterSimulation()
    path.afterSimulation()
    if conveyorSystem.drive then conveyorSystem.drive:afterSimulation(conveyorSystem.config) end
end

local configUi = ConfigUI('ConveyorSystem', SCHEMA, function(config) conveyorSystem.gen(config) end)

function configUi.getObjectCallback() return path.model end

return conveyorSystem
