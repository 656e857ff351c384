-- A supervisor that calls functions of its workers: it asks who they are, hands out work, and reads back what came of it.
--
--     swanilda run scenes/messaging/supervisor.lua
--
-- Three ways to talk are in use: functions called by name, custom data that stays with a worker, and the notice a script gets when the
-- data of its object changes.

sim = require 'sim'

local WORKERS = 3
local JOBS = 7

-- A worker tells how far the numbers it is given are apart. It works one step on each job.
local WORKER = [[
sim = require 'sim'

local me = sim.getObject('..')
local job

function introduce() return sim.getObjectAlias(me), 'I tell how far numbers are apart' end

function isBusy() return job ~= nil end

function begin(numbers)
    if job then error('I have work already') end
    job = numbers
end

function sysCall_actuation()
    if not job then return end
    table.sort(job)
    local done = sim.readCustomTableData(me, 'done')
    done[#done + 1] = job[#job] - job[1]
    sim.writeCustomTableData(me, 'done', done)
    job = nil
end

function sysCall_data(changed, namespace)
    if namespace == 'customData' and changed.done then
        print(sim.getObjectAlias(me) .. ' notes: ' .. table.concat(sim.readCustomTableData(me, 'done'), ', '))
    end
end
]]

local workers, nextJob, finished = {}, 1, false

function sysCall_init()
    for number = 1, WORKERS do
        local body = sim.createDummy(0.1)
        sim.setObjectAlias(body, 'worker' .. number)
        local script = sim.createScript(sim.scripttype_simulation, WORKER)
        sim.setObjectParent(script, body, false)
        workers[number] = {body = body, script = script}
    end
end

local function distribute()
    for _, worker in ipairs(workers) do
        if nextJob <= JOBS and not sim.callScriptFunction('isBusy', worker.script) then
            local numbers = {}
            for i = 1, 4 do numbers[i] = (nextJob * 7 + i * i * 5) % 23 end
            -- getScriptFunctions makes a call to another script look like one of one's own.
            sim.getScriptFunctions(worker.script):begin(numbers)
            nextJob = nextJob + 1
        end
    end
end

function sysCall_sensing()
    if sim.getSimulationTime() == 0 then
        for _, worker in ipairs(workers) do print(sim.callScriptFunction('introduce', worker.script)) end
        -- What a worker does not know is an error here.
        print(select(2, pcall(sim.callScriptFunction, 'makeCoffee', workers[1].script)))
    end
    distribute()
    local total = 0
    for _, worker in ipairs(workers) do total = total + #sim.readCustomTableData(worker.body, 'done') end
    if total == JOBS and not finished then
        finished = true
        print(total .. ' jobs are done.')
        sim.stopSimulation()
    end
end
