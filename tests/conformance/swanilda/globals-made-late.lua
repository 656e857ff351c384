-- topic: globals
-- as: customization
-- passes: 2
-- note: what scripts have without asking for it is there, whether it was used before or not
local function kinds(...)
    local names = {}
    for _, name in ipairs{...} do names[#names + 1] = name .. ' ' .. type(_G[name]) end
    print(table.concat(names, ', '))
end

print(getAsString(_G):find("simIK") ~= nil)
local seen = {}
for name, value in pairs(_G) do seen[name] = type(value) end
print(seen.sim, seen.simIK, seen.simROS2, seen.Matrix, seen.Vector7, seen.print, seen.map, seen.isbuffer, seen.operator)
kinds('sim', 'simIK', 'simGeom', 'Matrix', 'Matrix4x4', 'simRemoteApi', '_S', 'wrap', 'loadstring')
print(rawequal(simIK, simIK), getmetatable(simIK) == getmetatable(simUI), simNothing, Matrices)
simIM = 5
print(simIM)

-- functions that are loaded at their first call may yield in it
local thread = coroutine.wrap(function() foreach(function(x) coroutine.yield(x) end, {10, 20}) return 'end' end)
print(thread(), thread(), thread())
local first = map
print(table.concat(map(function(x) return 2 * x end, {1, 2, 3}), ' '), table.concat(first(function(x) return x end, {4}), ' '))
print(wrap(3, function(x) return x + 1 end))
local kept = reduce
reduce = function() return 'own' end
print(kept(operator.add, {1, 2, 3}), reduce())

-- extensions of the standard libraries
print(("a,b"):split(',')[2], table.slice and 'slice', type(math.sign), string.nothing)

-- buffers
local b = tobuffer('hello')
print(isbuffer(b), isbuffer('hello'), isbuffer(), #b, b .. ' world', 'say ' .. b, 1 .. b, b == tobuffer('hello'), b == tobuffer('x'), tostring(b))
print(b:upper(), string.rep(b, 2), b:sub(2, 3), b:byte(1, 2), b:find('l'), string.gsub(b, 'l', 'L'), b:match('e(.)'), #b:reverse())
print(string.unpack('<I2', tobuffer('\1\2')), string.len(b), tonumber(tobuffer('12')), tonumber('ff', 16), tonumber('10', 2), tonumber())
for word in string.gmatch(tobuffer('one two'), '%a+') do print(word) end
print(tostring(tobuffer(12)), tostring(tobuffer(nil)), tobuffer(b) == b, getmetatable(b).__isbuffer(b), b.upper == string.upper)

math.randomseed(2.5)
local x = math.random()
math.randomseed(2)
print(x == math.random())

-- implicit loading, then explicit
print(type(simIK.createEnvironment))
local sim = require 'sim'
print(type(sim), type(simIK), simUI, simGeom, simNothing)
print(Vector3({1, 2, 3})[2])
print(pcall(assert, false), pcall(assert, nil, 'text'), select('#', pcall(function() return nil, nil end)))
function sysCall_thread() print('thread', sim.getThreadId and 'id') sim.step() print('again') end

-- errors of functions of strings name the line of the call
local function reason(...) return (select(2, pcall(...)):gsub('^.*:%d+: ', '')) end
print(reason(function() string.find() end), reason(function() (b):rep({}) end))
print(select(2, pcall(function() string.len() end)):match('^%[string "(.-)"%]:%d+'))
