-- topic: signals
-- as: sandbox
-- passes: 0
-- spec: data 2; signals of each old kind, their properties, and how they are cleared
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function count(...) return select('#', ...) end

print('set', sim.setInt32Signal('a', 7), sim.setFloatSignal('a', 1.5), sim.setDoubleSignal('a', 2.5), sim.setStringSignal('a', 'text'))
print('get', sim.getInt32Signal('a'), sim.getFloatSignal('a'), sim.getDoubleSignal('a'), sim.getStringSignal('a'))
print('buffer', sim.getBufferSignal('a'), isbuffer(sim.getBufferSignal('a')), isbuffer(sim.getStringSignal('a')))
print('set', sim.setBufferSignal('a', 'bytes'), sim.getStringSignal('a'))

local scene = sim.handle_scene
print('properties', sim.getIntProperty(scene, 'signal.ILEGACY.a'), sim.getFloatProperty(scene, 'signal.FLEGACY.a'),
    sim.getFloatProperty(scene, 'signal.DLEGACY.a'), tostring(sim.getBufferProperty(scene, 'signal.SLEGACY.a')))

-- The kinds are independent of each other.
print('double', sim.clearDoubleSignal('a'), sim.clearDoubleSignal('a'), count(sim.getDoubleSignal('a')))
print('others', sim.getInt32Signal('a'), sim.getFloatSignal('a'), sim.getStringSignal('a'))
print('int', sim.clearInt32Signal('a'), sim.clearInt32Signal('a'), count(sim.getInt32Signal('a')))
print('float', sim.clearFloatSignal('a'), sim.clearFloatSignal('a'), count(sim.getFloatSignal('a')))
-- Strings and buffers are one kind.
print('buffer', sim.clearBufferSignal('a'), sim.clearBufferSignal('a'), count(sim.getStringSignal('a')), count(sim.getBufferSignal('a')))

for _, name in ipairs{'x', 'y', 'z'} do
    sim.setInt32Signal(name, 1)
    sim.setFloatSignal(name, 1.0)
    sim.setStringSignal(name, 'one')
end
sim.setDoubleSignal('x', 1.0)
print('all', sim.clearInt32Signal(), sim.clearFloatSignal(), sim.clearStringSignal(), sim.clearDoubleSignal())
print('again', sim.clearInt32Signal(), sim.clearFloatSignal(), sim.clearStringSignal(), sim.clearDoubleSignal())
print('illegal name', sim.setDoubleSignal('a-b', 1.0), count(sim.getDoubleSignal('a-b')), sim.setBufferSignal('a b', 'x'), count(sim.getBufferSignal('a b')))
