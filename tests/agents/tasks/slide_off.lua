-- A parameter of a scene that decides between two outcomes.
return {
    task = 'At which inclination of the board /Ramp (degrees, about y, within 2 degrees) does the block /Block begin to slide?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local ramp = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {2, 0.5, 0.05})
    sim.setObjectAlias(ramp, 'Ramp')
    sim.setObjectPosition(ramp, {0, 0, 1.5})
    sim.setBoolProperty(ramp, 'respondable', true)
    local block = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.05})
    sim.setObjectAlias(block, 'Block')
    sim.setObjectPosition(block, {0, 0, 1.5501})
    sim.setBoolProperty(block, 'dynamic', true)
    sim.setBoolProperty(block, 'respondable', true)
    sim.setObjectParent(block, ramp, true)
end
]==],
    solve = function(call)
        local variants = {}
        for degrees = 10, 60, 2 do
            variants[tostring(degrees)] = string.format("sim.setObjectOrientation(sim.getObject('/Ramp'), {0, math.rad(%d), 0})", degrees)
        end
        local tried = call('compare_variants', {variants = variants, time = 1, measure = {'/Block.position[1]'}}).values.variants
        local least
        for _, variant in ipairs(tried) do
            local _, x = next(variant.quantities)
            local degrees = tonumber(variant.variant)
            if x.largest - x.least > 0.02 and (not least or degrees < least) then least = degrees end
        end
        return least
    end,
    check = function(call, answer)
        if not answer then return 'there is no answer' end
        local function slides(degrees)
            call('simulation', {action = 'stop'})
            call('set_properties', {values = {['/Ramp.orientation'] = {0, math.rad(degrees), 0}}})
            local rows = call('run_until', {time = 1, watch = {'/Block.position[1]'}}).values.samples.rows
            return math.abs(rows[#rows][2] - rows[1][2]) > 0.02
        end
        if not slides(answer) or slides(answer - 4) then return answer .. ' degrees' end
    end,
}
