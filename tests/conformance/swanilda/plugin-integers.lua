-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: conventions 3
-- note: functions of plugins cut the fraction of floats they take for integers, also in tables; a float just below an integer is that integer
sim = require 'sim'
local simUI, simIM, simIK, simWS = require 'simUI', require 'simIM', require 'simIK', require 'simWS'
local ui = simUI.create '<ui><hslider id="1" minimum="0" maximum="100"/><combobox id="4"/><table id="5"/></ui>'
for _, value in ipairs {12, 12.5, 12.95, 12.85, 50.0} do
    simUI.setSliderValue(ui, 1.0, value)
    print(value, simUI.getSliderValue(ui, 1))
end
simUI.setRowCount(ui, 5, 2.0)
print('rows', simUI.getRowCount(ui, 5.0))
simUI.setSize(ui, 300.0, 200.7)
print('size', simUI.getSize(ui))
print('a text', (pcall(simUI.setSliderValue, ui, 1, 'x')))
local image = simIM.create(4.5, 3)
print('image', simIM.size(image))
local env = simIK.createEnvironment()
local dummy = simIK.createDummy(env)
print('no object', simIK.getObjectParent(env, dummy + 0.0), (pcall(simIK.getObjectParent, env, -1.0)))
print('server', (pcall(simWS.stop, simWS.start(0.4))))
local zmq = require 'simZMQ'
local context = zmq.ctx_new()
print('context', (pcall(zmq.ctx_set, context, zmq.IO_THREADS + 0.0, 1.0)))
-- Functions of sim itself that take integers take nothing else.
print('sim', (pcall(sim.getObjectAlias, sim.createDummy(0.1), 1.5)))
