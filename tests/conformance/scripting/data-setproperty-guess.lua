-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 1
sim = require 'sim'
local d = sim.createDummy(0.01)
for _, v in ipairs{1, 1.5, 's', true, {1}} do
    sim.setProperty(d, 'customData.a', v)
    print(v, (sim.getPropertyInfo(d, 'customData.a')), sim.getProperty(d, 'customData.a'))
end
sim.setProperty(d, 'customData.b', 3, sim.propertytype_float)
print((sim.getPropertyInfo(d, 'customData.b')))
sim.setProperty(d, 'customData.c', {1, 2, 3}, 'vector3')
print((sim.getPropertyInfo(d, 'customData.c')) == sim.propertytype_vector3)
local function tail(ok, e) return ok, (tostring(e):gsub('^.-: ', '')) end
print(tail(pcall(sim.setProperty, d, 'signal.a', 1)))
print(tail(pcall(sim.setProperty, d, 'layer', 1, sim.propertytype_int)))
print(tail(pcall(sim.setProperty, d, 'customData.f', print)))
print(tail(pcall(sim.getProperty, d, 'nope')))
print(sim.getProperty(d, 'nope', {noError = true}))
sim.setProperty(d, 'alias', 'renamed')
print(sim.getProperty(d, 'alias'), sim.getObjectAlias(d))
