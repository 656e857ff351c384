-- A controller whose gain is too large for its time step.
return {
    task = 'The arm /Base/Arm shakes instead of standing at 0.5 rad. Find out why, and repair it.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(base, 'Base')
    sim.setObjectPosition(base, {-0.2, 0, 1})
    local arm = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(arm, 'Arm')
    sim.setObjectPosition(arm, {0, 0, 1})
    sim.setObjectParent(arm, base, true)
    sim.setIntProperty(arm, 'dynCtrlMode', sim.jointdynctrl_velocity)
    sim.setJointTargetForce(arm, 1000)
    local rod = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.6, 0.05, 0.05})
    sim.setObjectAlias(rod, 'Rod')
    sim.setObjectPosition(rod, {0.3, 0, 1})
    sim.setBoolProperty(rod, 'dynamic', true)
    sim.setObjectParent(rod, arm, true)
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'

local gain = 60 -- 1/s

function sysCall_init() arm = sim.getObject('..') end

function sysCall_actuation()
    sim.setJointTargetVelocity(arm, gain * (0.5 - sim.getJointPosition(arm)))
end
]])
    sim.setObjectAlias(script, 'Control')
    sim.setObjectParent(script, arm, false)
end
]==],
    solve = function(call)
        local function spread()
            call('run_until', {time = 2})
            local rows = call('run_until', {time = 1, watch = {'/Base/Arm.jointPosition'}, rows = 100}).values.samples.rows
            local low, high = math.huge, -math.huge
            for _, row in ipairs(rows) do low, high = math.min(low, row[2]), math.max(high, row[2]) end
            call('simulation', {action = 'stop'})
            return high - low
        end
        assert(spread() > 0.1)
        -- A gain times the time step of more than one overshoots.
        local step = call('get_properties', {items = {'scene.timeStep'}}).values.values['scene.timeStep']
        local code = call('read_script', {script = '/Base/Arm/Control'}).text
        local gain = tonumber(code:match('gain = (%d+)'))
        assert(gain * step > 1)
        call('write_script', {script = '/Base/Arm/Control', old = 'gain = ' .. gain, new = 'gain = ' .. 0.2 / step})
        assert(spread() < 0.01)
    end,
    check = function(call)
        call('run_until', {time = 4})
        local rows = call('run_until', {time = 1, watch = {'/Base/Arm.jointPosition'}, rows = 100}).values.samples.rows
        for _, row in ipairs(rows) do
            if math.abs(row[2] - 0.5) > 0.02 then return string.format('it is at %g rad at %g s', row[2], row[1]) end
        end
    end,
}
