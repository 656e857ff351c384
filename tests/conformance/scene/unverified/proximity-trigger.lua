-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: sensors 1.2
-- tol: 1e-6
-- topic: sensors
sim = require 'sim'
local function str(v)
    if math.type(v) == 'integer' then return string.format('%d', v) end
    if type(v) == 'number' then return string.format('%.9f', math.abs(v) < 5e-10 and 0.0 or v) end
    if type(v) ~= 'table' then return tostring(v) end
    local t = {}
    for i, x in ipairs(v) do t[i] = str(x) end
    return '{' .. table.concat(t, ', ') .. '}'
end
local function P(label, ...) -- print values
    local t = {}
    for i = 1, select('#', ...) do t[i] = str((select(i, ...))) end
    print(label .. ': ' .. table.concat(t, ' '))
end
local function X(label, f, ...) -- print the tail of the error raised by f(...)
    local ok, e = pcall(f, ...)
    e = tostring(e):gsub('\nstack traceback.*', '')
    e = e:match("in sim[%w_%-]*%.[%w_]+: (.*)$") or e:match("in '[^']*': (.*)$") or e:match(':%d+: (.*)$') or e
    print(label .. ': ' .. (ok and 'no error' or 'error, ' .. e))
end
local function cube(size, ...)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size, size, size}, 0)
    sim.setObjectPosition(h, {...})
    return h
end
local s = sim.createProximitySensor(sim.proximitysensor_ray, 16, 1, {32, 32, 1, 16, 1, 1, 0, 0}, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.01, 0, 0})
local c = cube(0.2, 0, 0.02, 0.5)
local function script(code)
    local h = sim.createScript(sim.scripttype_customization, 'sim = require "sim" ' .. code)
    sim.setObjectParent(h, s)
    sim.initScript(h)
    return h
end
-- no answer, then an answer: the third script is not asked
script('function sysCall_trigger(inData) sim.setInt32Signal("first", inData.object) end')
local veto = script('function sysCall_trigger(inData) sim.setStringSignal("keys", sim.packTable(inData)) return {trigger = false} end')
script('function sysCall_trigger(inData) sim.setInt32Signal("third", 1) end')
P('vetoed', sim.handleProximitySensor(s))
P('read', sim.readProximitySensor(s))
P('asked', sim.getInt32Signal('first') == c, sim.getInt32Signal('third'))
local data, names = sim.unpackTable(sim.getStringSignal('keys')), {}
for name in pairs(data) do names[#names + 1] = name end
table.sort(names)
P('names', table.concat(names, ' '))
P('data', data.handle == s, data.proximitySensor == s, data.detectedObjectHandle == c, data.point, data.detectedPoint, data.normal, data.normalVector)
P('check asks nobody', (sim.checkProximitySensor(s, c)))
sim.removeObjects({veto})
P('without veto', (sim.handleProximitySensor(s)))
P('asked', sim.getInt32Signal('third'))
-- a script that removes the sensor, or what it detects
script('function sysCall_trigger(inData) sim.removeObjects({inData.object}) end')
P('removed', (sim.handleProximitySensor(s)))
P('read', sim.readProximitySensor(s))
cube(0.2, 0, 0.02, 0.5)
script('function sysCall_trigger(inData) sim.removeObjects({inData.handle}) end')
P('sensor removed', (sim.handleProximitySensor(s)))
P('sensor', sim.isHandle(s))
