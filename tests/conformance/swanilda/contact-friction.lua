-- as: simulation
-- passes: 20
-- engine: bullet278
-- spec: dynamics 9; the force of a contact is what one shape exerts on the other, friction included
-- tol: 1e-3
-- topic: dynamics
sim = require 'sim'

local function make(size, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    return shape
end

function sysCall_init()
    local slope = make({4, 4, 0.1}, false)
    sim.setObjectOrientation(slope, {0.2, 0, 0})
    box = make({0.2, 0.2, 0.2}, true)
    sim.setShapeMass(box, 1)
    sim.setObjectPose(box, sim.multiplyPoses(sim.getObjectPose(slope), {0, 0, 0.15, 0, 0, 0, 1}))
end

local steps = 0

function sysCall_sensing()
    steps = steps + 1
    if steps ~= 15 then return end
    local sum, index = {0, 0, 0}, 0
    while true do
        local shapes, _, force = sim.getContactInfo(5, box, index)
        if #shapes == 0 then break end
        for axis = 1, 3 do sum[axis] = sum[axis] + force[axis] end
        index = index + 1
    end
    print(string.format('%.3f %.3f %.3f', math.abs(sum[1]), math.abs(sum[2]), sum[3]))
end
