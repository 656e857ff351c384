-- topic: scripts
-- as: sandbox
-- passes: 0
-- spec: scripts 9, threads 2, vrep-era 2.3, vrep-era 2.12
-- note: yield levels, code and variables of a script, files it runs, and what there is no more
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function count(...) return select('#', ...) end

-- Levels: false adds one, true takes one away, a number sets it.
print('auto', sim.getAutoYield())
sim.setAutoYield(false)
sim.setAutoYield(false)
print('auto', sim.getAutoYield())
print('same', sim.getThreadAutomaticSwitch())
sim.setAutoYield(true)
print('auto', sim.getAutoYield())
sim.setAutoYield(5)
print('auto', sim.getAutoYield())
sim.setAutoYield(0)
sim.setAutoYield(true)
print('auto', sim.getAutoYield())

local function switches(get, set)
    local first = get()
    set(false)
    set(false)
    local second = get()
    set(true)
    local third = get()
    set(true)
    return second, third, first == get()
end
-- The chunk may run at any level, but comes back to it.
print('overall', switches(sim.getYieldAllowed, sim.setYieldAllowed))
print('old', switches(sim.getThreadSwitchAllowed, sim.setThreadSwitchAllowed))
sim.setYieldAllowed(false)
print('one level', sim.getYieldAllowed(), sim.getThreadSwitchAllowed())
sim.setThreadSwitchAllowed(true)

print('code', sim.executeLuaCode('made = 4 return made * 2'))
print('code', made)
local ok, message = sim.executeLuaCode('return )')
print('code', ok, type(message))
ok, message = sim.executeLuaCode("error({code = 7})")
print('code', ok, message.code)

local function innermost()
    local trace = sim.getStackTraceback()
    return trace:match('^stack traceback:') ~= nil, trace:find("'innermost'", 1, true) ~= nil, trace:find("'nowhere'", 1, true)
end
print('trace', innermost())

text, number, truth, list = 'x', 1, false, {}
function global() end
local own = 3
local found = {}
for _, name in ipairs(sim.getUserVariables()) do found[name] = true end
print('variables', found.text, found.number, found.truth, found.list, found.made, found.own, found.global, found.print)

local path = os.tmpname()
local function write(path, code)
    local file = assert(io.open(path, 'w'))
    file:write(code)
    file:close()
end
write(path, "included = (included or 0) + 1 return 'result', included")
print('file', (sim.includeAbs(path)), included)
print('file', (sim.includeAbs(path)), included)
print('missing', (pcall(sim.includeAbs, path .. '.none')))
-- Relative to the scene.
local scene = path .. '.ttt'
sim.saveScene(scene)
local name = path:match('[^/\\]*$')
print('relative', (sim.includeRel(name)), included)
print('relative', (sim.include('/' .. name)), included)
print('command', (sim.include('/' .. name, 'included = 10')), included)
os.remove(scene)
os.remove(path)

local function has(plugins, name)
    for _, plugin in ipairs(plugins) do if plugin == name then return true end end
    return false
end
local before = has(sim.getLoadedPlugins(), 'simIM')
require 'simIM'
print('plugins', before, has(sim.getLoadedPlugins(), 'simIM'), has(sim.getLoadedPlugins(), 'simVision'))
print('native', sim.getPluginName(0), sim.openModule(sim.handle_all), sim.closeModule(sim.handle_all))
print('nothing', count(sim.fastIdleLoop(true)), count(sim.registerCodeEditorInfos('simName', 'text')))
print('threads', simEnableWorkThreads(4), count(simWaitForWorkThreads()), sim.enableWorkThreads(4))
for _, plan in ipairs{simGetPathPlanningHandle, simSearchPath, simInitializePathSearch, simPerformPathSearchStep} do
    local arguments = plan == simGetPathPlanningHandle and {'name'} or {1, 2, 3}
    print('path planning', (select(2, pcall(plan, table.unpack(arguments))):match('([^: ][^:]*%.)$')))
end
print('path planning', (pcall(simInitializePathSearch, 1, 2, 3)), (pcall(simPerformPathSearchStep, 1)), (pcall(simGetPathPlanningHandle, 'x')))

print('custom data', simAddSceneCustomData(42, 'abc'), simGetSceneCustomData(42), sim.readCustomStringData(sim.handle_scene, '_oldSceneCustomData_42_'))
print('custom data', '[' .. simGetSceneCustomData(7) .. ']', simAddSceneCustomData(42, ''), '[' .. simGetSceneCustomData(42) .. ']')

print('helpers', sim.auxFunc('headless'), sim.auxFunc('frexp', 8))
print('helpers', count(sim.auxFunc('no such command')))

-- Released, it can be acquired again.
for _ = 1, 2 do
    sim.systemSemaphore('swanilda-conformance', true)
    sim.systemSemaphore('swanilda-conformance', false)
end
print('semaphore')
