--[[
Script of the conveyors of CoppeliaSim 4.1 and 4.2: `conveyor = require('conveyor_customization')`, whose own `sysCall_init` calls `conveyor.init(config)`. Other
scripts drive it by the packed custom data `CONVMOV`: {vel=}, {offset=} (spec: models 5).
]]

path = require 'path_customization' -- scripts find these as globals, as in the original
simQHull = _quietRequire 'simQHull'
local belt = require 'swanilda.conveyors.belt'
local control = require 'swanilda.conveyors.control'
local parts = require 'swanilda.conveyors.parts'

local path = path
local conveyor = {}
_S.conveyor = conveyor

local FINGERPRINT <const> = 'CONVEYORSET'

-- Settings with `padSize` are older; the result has the later names.
local function modern(config)
    if not config.padSize then return config end
    return {
        length = config.length, width = config.padSize[2], radius = config.radius, color = config.padCol, frameColor = config.col,
        type = config.useRollers and 2 or 1, respondable = config.respondablePads, rollerCnt = config.rollerCnt,
        beltElementWidth = config.padSize[1], beltElementThickness = config.padSize[3], beltElementSpacing = config.interPadSpace,
        initPos = config.initPos, initVel = config.initVel,
    }
end

function path.shaping(poses, isClosed)
    local config = conveyor.settings
    return isClosed and config and belt.frame(belt.polygon(path), (belt.geometry(config)), config.width, config)
end

--- Makes the conveyor and puts it where it starts.
function conveyor.init(config)
    conveyor.config, conveyor.settings = config, modern(config)
    local settings = conveyor.settings
    path.init()
    conveyor.model = path.model
    local radius = belt.geometry(settings)
    local isNew = not parts.isMadeWith(conveyor.model, FINGERPRINT, config)
    if isNew then
        path.setPathShape(-1)
        belt.place(path, belt.controlPoses(settings.length, radius, 0), true)
        path.forceFullRebuild = true
        path.setup()
    end
    conveyor.setPathPos = belt.build(path, settings, path.paths[2], 0, isNew)
    parts.noteSettings(conveyor.model, FINGERPRINT, config)
    conveyor.drive = control.oldDrive(conveyor.model, 'offset', settings, conveyor.setPathPos)
    conveyor.setPathPos(conveyor.drive.pos)
end

function conveyor.actuation()
    if conveyor.drive then conveyor.drive.actuation() end
end

function conveyor.afterSimulation()
    if conveyor.drive then conveyor.drive.afterSimulation() end
end

function sysCall_actuation() conveyor.actuation() end

function sysCall_afterSimulation()
    path.afterSimulation()
    conveyor.afterSimulation()
end

return conveyor
