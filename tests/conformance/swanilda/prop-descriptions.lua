-- spec: data 3
-- What properties are, in a sentence of ours.
sim = require 'sim'
local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
local function text(target, name) return (select(3, sim.getPropertyInfo(target, name))) end
print(text(joint, 'jointPosition'))
print(text(joint, 'joint.position') == text(joint, 'jointPosition'), text(joint, 'modelNotDynamic') == text(joint, 'model.notDynamic'))
print(text(sim.handle_scene, 'gravity'))
print(text(joint, 'ode.bounce'))
sim.setIntProperty(joint, 'customData.mine', 1)
print("'" .. text(joint, 'customData.mine') .. "'", sim.getPropertyInfo(joint, 'nothing'))
for _, target in ipairs {sim.handle_app, sim.handle_scene, joint} do
    for name, info in pairs(sim.getPropertiesInfos(target)) do
        if info.infoTxt == '' and not name:find 'customData' then print('without a text', name) end
    end
end
