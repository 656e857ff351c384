-- A script that never does anything, since its callback has a wrong name.
return {
    task = 'The lamp post /Post should turn, but it stands still, without any error. Find out why, and repair it.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local post = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(post, 'Post')
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'

function sysCall_init() post = sim.getObject('..') end

function sysCall_actution()
    sim.setJointPosition(post, sim.getSimulationTime())
end
]])
    sim.setObjectAlias(script, 'Turning')
    sim.setObjectParent(script, post, false)
end
]==],
    solve = function(call)
        local found = call('check_code', {}).text
        local wrong, right = found:match('(sysCall_%w+) does not exist %(did you mean (sysCall_%w+)')
        call('write_script', {script = '/Post/Turning', old = wrong, new = right})
    end,
    check = function(call)
        local values = call('run_until', {time = 1, watch = {'/Post.jointPosition'}}).values
        local last = values.samples.rows[#values.samples.rows]
        if last[2] < 0.5 then return 'it has turned by ' .. last[2] .. ' rad' end
    end,
}
