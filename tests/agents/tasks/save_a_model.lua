-- A file: saved and loaded again, in a folder that is allowed.
local folder = os.tmpname()
os.remove(folder)
assert(os.execute('mkdir ' .. folder))

return {
    task = 'Save the robot /Robot as a model, empty the scene, and bring two of it into it.',
    arguments = {'--allow-write=' .. folder, '--allow-read=' .. folder},
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.3, 0.2, 0.1})
    sim.setObjectAlias(base, 'Robot')
    sim.setModelProperty(base, 0)
    local arm = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(arm, 'Arm')
    sim.setObjectParent(arm, base, true)
end
]==],
    solve = function(call)
        local file = folder .. '/robot.ttm'
        local saved = call('save', {path = file, model = '/Robot'})
        assert(not saved.isError, saved.text)
        call('load')
        for _ = 1, 2 do
            local loaded = call('load', {path = file, add = true})
            assert(not loaded.isError, loaded.text)
        end
        os.execute('rm -r ' .. folder)
    end,
    check = function(call)
        local arms = call('find_objects', {pattern = '*Arm', type = 'joint'}).values
        if not arms or #arms.objects ~= 2 then return 'there are ' .. (arms and #arms.objects or 0) .. ' arms' end
    end,
}
