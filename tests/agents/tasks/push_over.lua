-- The least force that topples a box, by halving an interval with snapshots.
return {
    task = 'Find the least horizontal force (along x, newtons, within 5 N) that topples the box /Tower when it acts on its upper edge for 1 s.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.4, 0.4, 1})
    sim.setObjectAlias(box, 'Tower')
    sim.setObjectPosition(box, {0, 0, 0.5})
    sim.setShapeMass(box, 20)
    sim.setBoolProperty(box, 'dynamic', true)
    sim.setBoolProperty(box, 'respondable', true)
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
function sysCall_init() tower = sim.getObject('/Tower') force = 0 end
function setForce(newtons) force, begun = newtons, sim.getSimulationTime() end
function sysCall_actuation()
    if force > 0 and sim.getSimulationTime() < begun + 1 then sim.addForce(tower, {0, 0, 0.5}, {force, 0, 0}) end
end
]])
    sim.setObjectAlias(script, 'Push')
end
]==],
    solve = function(call)
        call('step', {count = 2})
        call('snapshot', {name = 'standing'})
        local low, high = 0, 400
        while high - low > 4 do
            local force = (low + high) / 2
            call('restore', {name = 'standing'})
            local set = call('run_code', {code = string.format("sim.callScriptFunction('setForce', sim.getObject('/Push'), %g)", force)})
            assert(not set.isError, set.text)
            local rows = call('run_until', {time = 3, watch = {'/Tower.position[3]'}}).values.samples.rows
            if rows[#rows][2] < 0.3 then high = force else low = force end
        end
        return high
    end,
    check = function(call, answer)
        if not answer then return 'there is no answer' end
        call('simulation', {action = 'stop'})
        local function topples(force)
            call('step', {count = 2})
            call('run_code', {code = string.format("sim.callScriptFunction('setForce', sim.getObject('/Push'), %g)", force)})
            local rows = call('run_until', {time = 3, watch = {'/Tower.position[3]'}}).values.samples.rows
            call('simulation', {action = 'stop'})
            return rows[#rows][2] < 0.3
        end
        if not topples(answer) then return answer .. ' N does not topple it' end
        if topples(answer - 6) then return 'less than ' .. answer .. ' N topples it' end
    end,
}
