-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.3, vrep-era 2.8, poses 3, poses 1; what old functions return, whether they do anything or not
-- tol: 1e-9
-- topic: old functions
sim = require 'sim'

local function show(what, ...)
    local t = table.pack(...)
    for i = 1, t.n do t[i] = getAsString(t[i]) end
    print(what, t.n, table.concat(t, ' '))
end

-- Nothing happens, or everything has happened already.
show('handleMechanism', sim.handleMechanism(1))
show('handleMill, resetMill, resetMilling', sim.handleMill(1), sim.resetMill(1), sim.resetMilling(1))
show('handleVarious', sim.handleVarious())
show('work threads', sim.enableWorkThreads(2), sim.waitForWorkThreads())
show('threads', sim.setThreadIsFree(true))
show('modules', sim.openModule(sim.handle_all), sim.closeModule(sim.handle_all), sim.handleModule(sim.handle_all, true))
show('names', (sim.getPluginName(0)), (sim.getModuleName(0)))
show('globals', simLockInterface(true), simGetInstanceIndex(), sim.isScriptExecutionThreaded(), sim.isScriptRunningInThread(), sim.setThreadResumeLocation(0, 0))
show('dialogs', sim.displayDialog('title', 'text', 0, false), sim.getDialogResult(1), sim.getDialogInput(1))
show('deprecated', sim.isDeprecated('sim.handleMill'))
print((pcall(sim.displayDialog, 'title', 'text', 'style', false)))

-- Bits of numbers, fractions cut off.
show('and', sim.boolAnd32(12, 10), sim.boolAnd16(12.0, 10.0))
show('or', sim.boolOr32(12, 10), sim.boolOr16(12.5, 10))
show('exclusive or', sim.boolXor32(12, 10), sim.boolXor16(12, 10.5))

-- The inverse, in place or not; what a table holds behind its numbers stays.
local function rounded(list)
    local t = {}
    for i, x in ipairs(list) do t[i] = type(x) == 'number' and string.format('%.4f', x):gsub('^%-(0%.0000)$', '%1') or x end
    return table.concat(t, ' ')
end
-- x, y, z -> -y + 1, x + 2, z + 3; back: y - 2, -x + 1, z - 3.
local matrix = {0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3}
print('another table', rounded(sim.getInvertedMatrix(matrix)), rounded(simGetInvertedMatrix(matrix)), rounded(matrix))
matrix[13] = 'kept'
show('in place', sim.invertMatrix(matrix))
print(rounded(matrix))
local pose = {1, 2, 3, 0, 0, math.sqrt(0.5), math.sqrt(0.5), 'kept'}
show('in place', sim.invertPose(pose))
print(rounded(pose))

-- Milliseconds.
print('global', simGetSystemTimeInMilliseconds() <= math.ceil(sim.getSystemTime() * 1000))
local now = sim.getSystemTime()
local ms = sim.getSystemTimeInMilliseconds()
print('milliseconds', math.type(ms), ms >= math.floor(now * 1000), ms <= math.ceil(sim.getSystemTime() * 1000))
local since = sim.getSystemTimeInMilliseconds(ms)
print('since then', math.type(since), since >= 0, since <= math.ceil(sim.getSystemTime() * 1000) - ms)

-- Messages without wires.
sim.sendData(0, 1, 'a name', 'first')
sim.sendData(0, 2, 'a name', 'second')
sim.sendData(0, 1, 'a_name', 'third')
show('received', sim.receiveData(1, 'a name'))
show('received', sim.receiveData(1, 'a name'))
show('received', sim.receiveData(2.0, 'a name'))
show('received', sim.receiveData(1, 'a_name'))

-- Names after others.
local first, second, third = sim.createDummy(0.1), sim.createDummy(0.1), sim.createDummy(0.1)
sim.setObjectName(first, 'arm#3')
sim.setSimilarName(second, 'arm#3', '_copy')
print(sim.getObjectName(second))
sim.setSimilarName(third, 'arm#3', '_copy')
print(sim.getObjectName(third))
sim.setSimilarName(first, 'arm#3', '_copy')
print(sim.getObjectName(first))
sim.setSimilarName(first, 'arm#3', '_copy')
print('again', sim.getObjectName(first))
sim.setSimilarName(second, 'leg', '')
print(sim.getObjectName(second))

-- Warnings that name the line; one advice, once.
show('tracing', simHandleTracing(), simResetTracing())
show('child scripts', simHandleChildScript(sim.handle_all))
show('child scripts', simHandleChildScript(sim.handle_all))

-- Handles by name: the last number of the global allows that there is none.
local function handle(what, ...)
    local ok, result = pcall(...)
    print(what, ok, ok and (result == first and 'the first' or result == third and 'the third' or result) or 'refused')
end
sim.setObjectAlias(third, 'twin')
sim.setObjectAlias(first, 'twin')
sim.setObjectName(first, 'named')
handle('name', simGetObjectHandle, 'named')
handle('no name', simGetObjectHandle, 'nobody')
handle('no name, no error', simGetObjectHandle, 'nobody', -1, -1, 1)
handle('no name, other option', simGetObjectHandle, 'nobody', -1, -1, 2)
handle('no name, both options', simGetObjectHandle, 'nobody', -1, -1, 3)
handle('path', simGetObjectHandle, '/twin', 0)
handle('path, the second', simGetObjectHandle, '/twin', 1)
handle('path, the third', simGetObjectHandle, '/twin', 2, -1, 1)
handle('by name', sim.getObjectHandle_noErrorNoSuffixAdjustment, 'named')
handle('by name, none', sim.getObjectHandle_noErrorNoSuffixAdjustment, 'nobody')
print(sim.getNameSuffix('arm#12'))
print(sim.getNameSuffix('arm12'))
print(sim.getNameSuffix('arm#'))
print(sim.getNameSuffix(), sim.setNameSuffix(4), sim.getNameSuffix())
