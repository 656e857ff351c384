-- How long the steps of a scene or model take: loads FILE, starts, and prints the milliseconds of the first step, of most (their median) and of the longest one.
--
--     FILE=scene.ttt STEPS=60 swanilda serve --no-remote-api --addon benches/scene_steps.lua
--
-- A model is loaded into the default scene. Scenes of others that are made of many parts are in packages for Python, such as `poppy-ergo-jr`.
sim = require 'sim'

local FILE <const>, STEPS <const> = os.getenv('FILE'), tonumber(os.getenv('STEPS') or 100)

local loops, times = 0, {}
local before

function sysCall_init() end

function sysCall_nonSimulation()
    loops = loops + 1
    if loops == 1 then
        local load = FILE:match('%.ttm$') and sim.loadModel or sim.loadScene
        load(FILE)
    elseif loops == 2 then
        sim.startSimulation()
    elseif #times >= STEPS then
        sim.quitSimulator()
    end
end

local function report()
    local first = times[1]
    table.sort(times)
    print(string.format('a step of %.0f ms: first %.3f, median %.3f, longest %.3f ms', 1000 * sim.getSimulationTimeStep(),
        first, times[(#times + 1) // 2], times[#times]))
end

function sysCall_beforeMainScript()
    local now = sim.getSystemTime()
    if before then times[#times + 1] = 1000 * (now - before) end
    if #times == STEPS then
        report()
        sim.stopSimulation()
    end
    before = sim.getSystemTime()
end
