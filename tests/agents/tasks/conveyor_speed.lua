-- A value that is found by trying variants.
return {
    task = 'The carriage /Rail/Carriage shall be at 1.5 m after 3 s (within 3 cm). Set the velocity of /Rail, which is driven at a velocity.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local rail = sim.createJoint(sim.joint_prismatic, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(rail, 'Rail')
    sim.setObjectPosition(rail, {0, 0, 0.5})
    sim.setObjectOrientation(rail, {0, math.pi / 2, 0})
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(base, 'Base')
    sim.setObjectPosition(base, {-0.5, 0, 0.5})
    sim.setObjectParent(rail, base, true)
    sim.setJointInterval(rail, false, {0, 5})
    sim.setIntProperty(rail, 'dynCtrlMode', sim.jointdynctrl_velocity)
    sim.setJointTargetForce(rail, 100)
    sim.setJointTargetVelocity(rail, 0.1)
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(box, 'Carriage')
    sim.setObjectPosition(box, {0, 0, 0.5})
    sim.setBoolProperty(box, 'dynamic', true)
    sim.setObjectParent(box, rail, true)
end
]==],
    solve = function(call)
        local variants, best = {}, nil
        for i = 1, 10 do variants[string.format('%.1f', i / 10)] = string.format("sim.setJointTargetVelocity(sim.getObject('/Rail'), %g)", i / 10) end
        local tried = call('compare_variants', {variants = variants, time = 3, measure = {'/Rail.jointPosition'}}).values.variants
        for _, variant in ipairs(tried) do
            local _, measured = next(variant.quantities)
            local off = math.abs(measured.last - 1.5)
            if not best or off < best.off then best = {off = off, name = variant.variant} end
        end
        call('set_properties', {values = {['/Rail.targetVel'] = tonumber(best.name)}})
    end,
    check = function(call)
        local rows = call('run_until', {time = 3, watch = {'/Rail/Carriage.position[1]'}}).values.samples.rows
        local last = rows[#rows][2]
        if math.abs(last - 1.5) > 0.03 then return 'it is at ' .. last end
    end,
}
