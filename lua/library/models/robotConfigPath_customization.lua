--[[
Script of the paths that models.robotConfigPath-3 makes: settings show one of their states, by the ghost of the child `State` (spec: models 6).

    getPath()                                     the states, a list of lists of positions
]]

local sim = _quietRequire 'sim'
require 'configUi'

local SCHEMA <const> = {
    showState = {name = 'Show state', type = 'bool', default = false, ui = {order = 1}},
    stateIndex = {name = 'State', type = 'int', default = 1, minimum = 1, ui = {order = 2}},
    showTipPath = {name = 'Show path of the tip', type = 'bool', default = false, ui = {order = 3}},
    forward = {name = 'Next', ui = {order = 4}},
    backward = {name = 'Previous', ui = {order = 5}},
}

function getPath() return sim.readCustomTableData(sim.getObject('.'), 'path') end

local function move(by)
    return function(settings)
        settings.config.stateIndex = math.max(1, math.min(#getPath(), settings.config.stateIndex + by))
    end
end
SCHEMA.forward.callback, SCHEMA.backward.callback = move(1), move(-1)

local function show(config)
    local state = getPath()[config.stateIndex]
    local ghost = sim.getObject('./State', {noError = true})
    if not state or not ghost or ghost == -1 then return end
    sim.callScriptFunction('setConfig', ghost, state)
    sim.callScriptFunction(config.showState and 'createModelClone' or 'removeModelClone', ghost)
end

local settings = ConfigUI('RobotConfigPath', SCHEMA, show)

function settings.getObjectCallback() return sim.getObject('.') end
