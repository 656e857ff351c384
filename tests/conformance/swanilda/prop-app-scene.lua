-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 1, properties 6
-- note: properties of the application and the scene, and the numbered parameters that are the same values
sim = require 'sim'
local app, scene = sim.handle_app, sim.handle_scene
local function refused(f, ...) local ok, message = pcall(f, ...) print(ok, (tostring(message):gsub('^%-?%d+: ', ''))) end

print(sim.getStringProperty(app, 'productVersion'), sim.getIntProperty(app, 'productVersionNb'), sim.getInt32Param(sim.intparam_program_full_version))
sim.setStringProperty(app, 'statusbarVerbosityStr', 'warnings')
print(sim.getIntProperty(app, 'statusbarVerbosity'), sim.getInt32Param(sim.intparam_statusbarverbosity))
refused(sim.setStringProperty, app, 'statusbarVerbosityStr', 'loud')
refused(sim.getStringProperty, app, 'statusbarVerbosityStr')
refused(sim.setStringProperty, app, 'sessionId', 'x')
sim.setInt32Param(sim.intparam_idle_fps, 20)
print(sim.getIntProperty(app, 'app.idleFps'), sim.getIntProperty(app, 'idleFps'))
local word, float = sim.getStringProperty(app, 'randomString'), sim.getFloatProperty(app, 'randomFloat')
print(#word, word:match('^%w+$') == word, float >= 0 and float < 1, float ~= sim.getFloatProperty(app, 'randomFloat'))

local function counters()
    local values = {}
    for i, name in ipairs{'objectCreationCounter', 'objectDestructionCounter', 'hierarchyChangeCounter'} do
        values[i] = sim.getIntProperty(scene, name)
    end
    return values
end
local before = counters()
local a, b = sim.createDummy(0.1), sim.createDummy(0.1)
sim.setObjectParent(a, b)
sim.removeObjects({a})
local after = counters()
print(after[1] - before[1], after[2] - before[2], after[3] > before[3])
sim.setArrayParam(sim.arrayparam_ambient_light, {0.5, 0.25, 0.125})
print(sim.getColorProperty(scene, 'ambientLight'))
sim.setIntArrayProperty(scene, 'dynamicsEngine', {1, 0})
print(sim.getInt32Param(sim.intparam_dynamic_engine))
refused(sim.setIntArrayProperty, scene, 'dynamicsEngine', {99, 0})
refused(sim.setFloatProperty, scene, 'timeToPause', 0 / 0)

sim.setStringProperty(scene, 'customData.short', 'x')
sim.setStringProperty(scene, 'customData.long', ('x'):rep(2000))
print(select(2, sim.getPropertyInfo(scene, 'customData.short')), select(2, sim.getPropertyInfo(scene, 'customData.long')))
local small = sim.getProperties(scene, {skipLarge = true})
print(small['customData.short'], small['customData.long'], small.timeStep)
