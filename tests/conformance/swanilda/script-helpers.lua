-- as: sandbox
-- passes: 1
-- spec: calls 2, scripts 9, addressing 2; functions of other scripts, variables and modules of this one, files that are run
-- topic: scripts
sim = require 'sim'

local function refused(what, f)
    local _, message = pcall(f)
    print(what, (tostring(message):gsub('/tmp/[%w_]+', 'FILE')))
end

-- Scripts by handle, by object and by path; with and without a type.
local object = sim.createDummy(0.1)
sim.setObjectAlias(object, 'robot')
local function script(kind, word)
    local h = sim.createScript(kind, ("function who(a, b) return '%s', a, b end"):format(word), 0, 'lua')
    sim.setObjectParent(h, object, true)
    sim.initScript(h)
    return h
end
local customization = script(sim.scripttype_customization, 'customization')
print(sim.getScriptFunctions(customization):who(1, 2))
print(sim.getScriptFunctions(object):who(3))
print(sim.getScriptFunctions('/robot'):who())
print(sim.getScriptFunctions(object, sim.scripttype_customization):who())
-- A script is meant itself, also where another one lies below it.
local below = script(sim.scripttype_customization, 'below')
sim.setObjectParent(below, customization, true)
print(sim.getScriptFunctions(customization):who(4))
sandboxFunction = function(x) return x + 1 end
local own = sim.getScriptFunctions(sim.getScript(sim.scripttype_sandbox))
print(tostring(own):gsub('%d+', 'N'), tostring(sim.getScriptFunctions(customization)) == 'functions of script ' .. customization)
refused('with a dot', function() sim.getScriptFunctions(customization).who(1) end)
refused('with a dot and a table', function() sim.getScriptFunctions(customization).who({}) end)
refused('of something else', function() sim.getScriptFunctions(customization).who(setmetatable({}, {})) end)
refused('unknown', function() sim.getScriptFunctions(customization):nobody() end)
local simulation = sim.createScript(sim.scripttype_simulation, '', 0, 'lua')
sim.setObjectParent(simulation, object, true)
print(tostring(sim.getScriptFunctions(object, sim.scripttype_simulation)) == 'functions of script ' .. simulation)

-- Variables.
myNumber, myText, myTable, _hidden, simOther, similar = 1, 'a', {}, {}, {}, 5
function myFunction() end
print(table.concat(sim.getUserVariables(), ' '))

-- Code.
print(sim.executeLuaCode('fromCode = 5 return fromCode, 6'))
print(fromCode)
print(sim.executeLuaCode('return = 5'))
print(sim.executeLuaCode("error('raised', 0)"))

-- Plugins.
print(sim.isPluginLoaded('simIK'), sim.isPluginLoaded('nobody'))
sim_plugin_namespaces = {simZ = 'simZ', simA = 'simA'}
local function loaded() return table.concat(sim.getLoadedPlugins(), ' '):find('simA.*simZ') ~= nil end
print(loaded(), sim.isPluginLoaded('simA'), sim.isPluginLoaded('simB'))
sim_plugin_namespaces = {}
print(loaded(), sim.isPluginLoaded('simA'))
require 'simIK'
print(sim.isPluginLoaded('simIK'))
print(sim.loadPlugin('simIK'))
print(select('#', sim.fastIdleLoop(true)))

-- Files.
local path = os.tmpname()
local function write(text)
    local file = io.open(path, 'w')
    file:write(text)
    file:close()
end
write("included = (included or 0) + 1 return 'result', included")
print(sim.includeAbs(path), included)
local name, up = path:match('([^/]+)$'), string.rep('../', 20)
print(sim.includeRel(up .. 'tmp/' .. name), included)
print(sim.include(up .. 'tmp/' .. name), included)
write('return = 5')
refused('no Lua', function() sim.includeAbs(path) end)
refused('no Lua', function() sim.includeRel(up .. 'tmp/' .. name) end)
refused('no Lua', function() sim.include(up .. 'tmp/' .. name) end)
os.remove(path)
refused('no file', function() sim.includeAbs(path) end)
print('module', sim.include('/lua/tablex.lua') == require 'tablex', sim.include('lua/socket/url.lua') == require 'socket.url')
refused('no module', function() sim.include('/lua/nobody.lua') end)

-- Files beside the scene; they go before modules.
local folder = os.tmpname()
os.remove(folder)
local lfs = require 'lfs'
lfs.mkdir(folder)
lfs.mkdir(folder .. '/lua')
sim.saveScene(folder .. '/scene.ttt')
path = folder .. '/lua/tablex.lua'
write("return 'beside the scene'")
print(sim.includeRel('lua/tablex.lua'), sim.include('/lua/tablex.lua'))
os.remove(path)
print(sim.include('/lua/tablex.lua') == require 'tablex')
os.remove(folder .. '/scene.ttt')
lfs.rmdir(folder .. '/lua')
lfs.rmdir(folder)

-- Variables of others.
print(sim.setScriptVariable('given', customization, {1, 2}))
print(sim.callScriptFunction('getAsString', customization, 1), sim.executeScriptString('given[2]', customization))
print(sim.setScriptVariable('given@/robot', sim.scripttype_customization, 'by path'))
print(sim.executeScriptString('given', customization))
print(sim.setScriptVariable('ownNumber', sim.getScript(sim.scripttype_sandbox), 7), ownNumber)

-- Without an object, the type of the main script means the main script.
registerScriptFuncHook('sysCall_sensing', function()
    if sim.getSimulationTime() > 0 then return end
    print('main', sim.setScriptVariable('given', sim.scripttype_main, 'by type'))
    print(sim.executeScriptString('given', sim.getScript(sim.scripttype_main)))
end, true)
