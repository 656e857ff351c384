-- An old script: names from before there were modules, and one function for all callbacks.
return {
    task = 'The script /Motor/Old was written for V-REP. Port it to the present API, with the callbacks of today.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local motor = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(motor, 'Motor')
    local script = sim.createScript(sim.scripttype_simulation, [[
if (sim_call_type==sim_childscriptcall_initialization) then
    motor=simGetObjectAssociatedWithScript(sim_handle_self)
    speed=0.5
end
if (sim_call_type==sim_childscriptcall_actuation) then
    simSetJointPosition(motor,simGetJointPosition(motor)+speed*simGetSimulationTimeStep())
end
]])
    sim.setObjectAlias(script, 'Old')
    sim.setObjectParent(script, motor, false)
end
]==],
    solve = function(call)
        local old = call('read_script', {script = '/Motor/Old'}).text
        assert(old:find('simSetJointPosition'), old)
        assert(call('api', {name = 'sim.setJointPosition'}).text:find('sim.setJointPosition', 1, true))
        local answer = call('write_script', {script = '/Motor/Old', code = [[
sim = require 'sim'

function sysCall_init()
    motor = sim.getObject('..')
    speed = 0.5
end

function sysCall_actuation()
    sim.setJointPosition(motor, sim.getJointPosition(motor) + speed * sim.getSimulationTimeStep())
end
]]})
        assert(not answer.isError and not answer.text:find('does not exist'), answer.text)
    end,
    check = function(call)
        local text = call('read_script', {script = '/Motor/Old'}).text
        if text:find('sim_call_type') or text:find('simGet') or text:find('simSet') then return 'it has old names' end
        local rows = call('run_until', {time = 2, watch = {'/Motor.jointPosition'}}).values.samples.rows
        if math.abs(rows[#rows][2] - 1) > 0.06 then return 'it is at ' .. rows[#rows][2] end
    end,
}
