--[[
Script of the conveyor systems of CoppeliaSim 4.1 and 4.2: `conveyorSystem = require('conveyorSystem_customization')`, whose own `sysCall_init` calls
`conveyorSystem.init(config)`. Other scripts drive it by the packed custom data `CONVMOV`: {vel=}, {pos=} (spec: models 5). Without borders.
]]

path = require 'path_customization' -- scripts find these as globals, as in the original
simQHull = _quietRequire 'simQHull'
local along = require 'swanilda.conveyors.along'
local control = require 'swanilda.conveyors.control'
local parts = require 'swanilda.conveyors.parts'

local path = path
local conveyorSystem = {}
_S.conveyorSystem = conveyorSystem

local CLOSED <const> = 2

local function planOf(config)
    local pad, roller = config.padSize or {0.05, 0.2, 0.005}, config.rollerSize or {0.05, 0.2}
    return {
        isClosed = path.readInfo().bitCoded & CLOSED ~= 0, width = config.useRollers and roller[2] or pad[2], useRollers = config.useRollers,
        pad = {length = pad[1], thickness = pad[3], spacing = config.interPadSpace or 0},
        roller = {radius = roller[1] / 2, spacing = config.interPadSpace or 0},
        color = parts.colour(config.padCol), frameColor = parts.colour(config.col), respondable = config.respondablePads ~= false,
    }
end

function path.refreshTrigger()
    if not conveyorSystem.config then return end
    conveyorSystem.setPathPos = along.build(path, planOf(conveyorSystem.config))
    conveyorSystem.setPathPos(conveyorSystem.drive and conveyorSystem.drive.pos or conveyorSystem.config.initPos or 0)
end

--- Makes the conveyor and puts it where it starts.
function conveyorSystem.init(config)
    conveyorSystem.config = config
    path.init()
    conveyorSystem.model = path.model
    conveyorSystem.drive = control.oldDrive(path.model, 'pos', config, function(pos) conveyorSystem.setPathPos(pos) end)
end

function conveyorSystem.actuation()
    if conveyorSystem.drive then conveyorSystem.drive.actuation() end
end

function conveyorSystem.afterSimulation()
    if conveyorSystem.drive then conveyorSystem.drive.afterSimulation() end
end

function sysCall_actuation() conveyorSystem.actuation() end

function sysCall_afterSimulation()
    path.afterSimulation()
    conveyorSystem.afterSimulation()
end

return conveyorSystem
