-- as: addon
-- passes: 0
-- loops: 40
-- spec: simulation 7, callbacks 3; who hears of the stages of a step, of a pause and of the end, and in which order
-- topic: callbacks
sim = require 'sim'

local TELL <const> = [[
local sim = require 'sim'
for _, stage in ipairs{'actuation', 'sensing', 'suspend', 'suspended', 'resume', 'cleanup'} do
    _G['sysCall_' .. stage] = function() print(stage .. ' of %s') end
end
]]

local function script(kind, name) return sim.createScript(kind, TELL:format(name), 0, 'lua') end

local steps, pauses, runs = 0, 0, 0

function sysCall_info() return {autoStart = true} end

function sysCall_nonSimulation()
    runs = runs + 1
    if runs == 2 then sim.startSimulation() end
end

function sysCall_beforeSimulation()
    script(sim.scripttype_simulation, 'a simulation script')
    script(sim.scripttype_customization, 'a customization script')
    sim.executeScriptString([[
        for _, stage in ipairs{'actuation', 'sensing', 'suspend', 'suspended', 'resume'} do
            registerScriptFuncHook('sysCall_' .. stage, function() print(stage .. ' of the sandbox') end, true)
        end
    ]], sim.getScript(sim.scripttype_sandbox))
end

function sysCall_actuation()
    steps = steps + 1
    print('actuation of the add-on, step ' .. steps)
    if steps == 2 then sim.pauseSimulation() end
    if steps == 4 then sim.stopSimulation() end
end

function sysCall_sensing() print('sensing of the add-on') end
function sysCall_suspend() print('suspend of the add-on') end
function sysCall_resume() print('resume of the add-on') end
function sysCall_cleanup() print('cleanup of the add-on') end

function sysCall_suspended()
    pauses = pauses + 1
    print('suspended of the add-on')
    if pauses == 2 then sim.startSimulation() end
end
