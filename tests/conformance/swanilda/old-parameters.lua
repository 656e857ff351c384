-- topic: parameters
-- as: sandbox
-- passes: 0
-- spec: properties 1, properties 4, dynamics 6, scripts 8, vrep-era 2.2; parameters by their old functions, against the properties they are
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local app, scene = sim.handle_app, sim.handle_scene

sim.setFloatParameter(sim.floatparam_simulation_time_step, 0.02)
print('float', sim.getFloatParameter(sim.floatparam_simulation_time_step), sim.getFloatProperty(scene, 'timeStep'))
sim.setFloatProperty(scene, 'timeStep', 0.01)
print('float', sim.getFloatParameter(sim.floatparam_simulation_time_step))

sim.setBoolParameter(sim.boolparam_realtime_simulation, true)
print('bool', sim.getBoolParameter(sim.boolparam_realtime_simulation), sim.getBoolProperty(scene, 'realtimeSimulation'), sim.getIsRealTimeSimulation())
sim.setBoolProperty(scene, 'realtimeSimulation', false)
print('bool', sim.getBoolParameter(sim.boolparam_realtime_simulation), sim.getIsRealTimeSimulation())

sim.setArrayParameter(sim.arrayparam_gravity, {0.25, 0.5, -1})
print('array', sim.getArrayParameter(sim.arrayparam_gravity), sim.getVector3Property(scene, 'gravity'))

-- The levels of the log have numbers and words: 300 is that of warnings.
sim.setInt32Parameter(sim.intparam_statusbarverbosity, 200)
print('int', sim.getInt32Parameter(sim.intparam_statusbarverbosity), sim.getIntProperty(app, 'statusbarVerbosity'))
sim.setStringParameter(sim.stringparam_statusbarverbosity, 'warnings')
print('string', sim.getInt32Parameter(sim.intparam_statusbarverbosity), sim.getIntProperty(app, 'statusbarVerbosity'))
local file = os.tmpname() .. '.ttt'
sim.saveScene(file)
print('string', sim.getStringParameter(sim.stringparam_scene_path_and_name) == file)
os.remove(file)

sim.setInt32Parameter(sim.intparam_error_report_mode, 0)
print('silent', sim.getInt32Parameter(sim.intparam_error_report_mode), sim.getObjectParent(999999))
print('reason', sim.getLastError())
sim.setInt32Parameter(sim.intparam_error_report_mode, 1)
print('raises', (pcall(sim.getObjectParent, 999999)))

sim.setStringNamedParam('word', 'of old')
print('named', sim.getStringNamedParam('word'), sim.getStringProperty(app, 'namedParam.word'), select('#', sim.getStringNamedParam('other')))
sim.setNamedBoolParam('yes', true)
sim.setNamedBoolParam('no', false)
sim.setNamedInt32Param('whole', -42)
sim.setNamedFloatParam('half', 0.5)
print('named', sim.getNamedBoolParam('yes'), sim.getNamedBoolParam('no'), sim.getNamedInt32Param('whole'), sim.getNamedFloatParam('half'))
print('texts', type(sim.getStringNamedParam('yes')), sim.getStringNamedParam('whole'), sim.getStringNamedParam('half'))
print('missing', sim.getNamedBoolParam('other'), sim.getNamedInt32Param('other'), sim.getNamedFloatParam('other'))
sim.setStringProperty(app, 'namedParam.text', 'words')
print('no number', sim.getNamedInt32Param('text'), sim.getNamedFloatParam('text'))

-- User settings are named parameters, too.
sim.setStringProperty(app, 'namedParam.settings.count', '12')
sim.setStringProperty(app, 'namedParam.settings.isOn', 'true')
print('settings', sim.getSettingInt32('count'), sim.getSettingFloat('count') == 12, sim.getSettingString('count'), sim.getSettingBool('isOn'))
print('missing', sim.getSettingInt32('other'), sim.getSettingFloat('other'), sim.getSettingString('other'), sim.getSettingBool('other'))
print('deprecated', sim.isDeprecated('sim.getObject'))

-- Physics engines: of the scene, and of a shape.
local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
sim.setEngineFloatParameter(sim.bullet_body_restitution, box, 0.25)
print('engine', sim.getEngineFloatParameter(sim.bullet_body_restitution, box), sim.getFloatProperty(box, 'bullet.restitution'))
sim.setFloatProperty(box, 'ode.friction', 0.75)
print('engine', sim.getEngineFloatParameter(sim.ode_body_friction, box))
sim.setEngineInt32Parameter(sim.ode_body_maxcontacts, box, 3)
print('engine', sim.getEngineInt32Parameter(sim.ode_body_maxcontacts, box), sim.getIntProperty(box, 'ode.maxContacts'))
print('engine', sim.getEngineInt32Parameter(sim.bullet_global_constraintsolvingiterations, -1), sim.getEngineInt32Parameter(sim.newton_global_constraintsolvingiterations, -1))
for _, value in ipairs{true, false} do
    sim.setEngineBoolParameter(sim.bullet_body_sticky, box, value)
    print('engine', sim.getEngineBoolParameter(sim.bullet_body_sticky, box), sim.getEngineBoolParam(sim.bullet_body_sticky, box), sim.getBoolProperty(box, 'bullet.stickyContact'))
end
