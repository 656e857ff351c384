-- topic: callbacks
-- as: simulation
-- passes: 4
-- spec: callbacks 4
-- note: a saved model is a copy, a scene that is saved to a buffer is saved
sim = require 'sim'
local model = sim.createDummy(0.1)
sim.setModelProperty(model, 0)
sim.setObjectParent(sim.createDummy(0.1), model, true)
local pass = 0
function sysCall_beforeCopy(data) print('beforeCopy', #data.objects, data.objects[1] == model, data.objectHandles[model]) end
function sysCall_afterCopy(data) print('afterCopy', #data.objects) end
function sysCall_beforeSave(data) print('beforeSave', data.file == '', data.regularSave) end
function sysCall_afterSave(data) print('afterSave', data.file == '', data.regularSave) end
function sysCall_actuation()
    pass = pass + 1
    if pass ~= 2 then return end
    print('model', #sim.saveModel(model) > 100)
    local name = os.tmpname() .. '.ttm'
    print('file', sim.saveModel(model, name))
    os.remove(name)
    print('scene', #sim.saveScene() > 100)
end
