-- A signal of a script: when, and what happened then.
return {
    task = 'The script /Machine sets the signal done when it has finished. When is that, and where is the joint /Drill then?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local drill = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(drill, 'Drill')
    sim.setJointInterval(drill, false, {-1, 2})
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
function sysCall_actuation()
    local t = sim.getSimulationTime()
    sim.setJointPosition(sim.getObject('/Drill'), -0.1 * t)
    if t > 3.7 then sim.setInt32Signal('done', 1) end
end
]])
    sim.setObjectAlias(script, 'Machine')
end
]==],
    solve = function(call)
        local run = call('run_until', {['until'] = {signal = {name = 'done', value = 1}}, time = 20, watch = {'/Drill.jointPosition'}}).values
        local rows = run.samples.rows
        return run.reached and {time = run.time, position = rows[#rows][2]}
    end,
    check = function(_, answer)
        if not answer then return 'there is no answer' end
        if math.abs(answer.time - 3.75) > 0.11 or math.abs(answer.position + 0.375) > 0.02 then return answer.time .. ' s, ' .. answer.position end
    end,
}
