-- A broadcaster and its listeners: one script says something to all, whoever they are, and those who care answer.
--
--     swanilda run scenes/messaging/greeting.lua
--
-- A message is a table. By convention its `id` tells what it is about, and `data` holds the rest.

sim = require 'sim'

local NAMES = {'Franz', 'Coppelius', 'Burgomaster'}

-- A listener answers greetings that are meant for everyone or for it. It knows its name from the object it sits on.
local LISTENER = [[
sim = require 'sim'

function sysCall_msg(message, sender)
    if message.id ~= 'greeting' then return end
    local name = sim.getObjectAlias(sim.getObject('..'))
    if message.data.to and message.data.to ~= name then return end
    print('  ' .. name .. ' has heard: ' .. message.data.text)
    sim.broadcastMsg({id = 'answer', data = {from = name, to = sender}})
end
]]

function sysCall_init()
    self = sim.getScript(sim.handle_self)
    for _, name in ipairs(NAMES) do
        local body = sim.createDummy(0.1)
        sim.setObjectAlias(body, name)
        local listener = sim.createScript(sim.scripttype_simulation, LISTENER)
        sim.setObjectParent(listener, body, false)
    end
end

-- The answers come while broadcastMsg is still running: it returns when all have got the message.
function sysCall_msg(message)
    if message.id == 'answer' and message.data.to == self then answers = answers + 1 end
end

local function greet(text, to)
    answers = 0
    print(to and ('To ' .. to .. ':') or 'To everyone:')
    sim.broadcastMsg({id = 'greeting', data = {text = text, to = to}})
    print('  ' .. answers .. (answers == 1 and ' answer' or ' answers'))
end

function sysCall_sensing()
    local step = math.floor(sim.getSimulationTime() / sim.getSimulationTimeStep() + 0.5)
    if step == 0 then greet('good morning!') end
    if step == 1 then greet('is your doll at home?', 'Coppelius') end
    if step == 2 then greet('is anybody there?', 'Swanilda') end
    if step == 3 then sim.stopSimulation() end
end
