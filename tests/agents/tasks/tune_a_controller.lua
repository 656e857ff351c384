-- Two gains: fast, and without overshoot.
return {
    task = 'The script /Slider/Control drives the mass to 1 m by a force, with the gains kp and kd. Choose them: after 4 s it shall be within 2 cm of 1 m, and never beyond 1.05 m.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local slider = sim.createJoint(sim.joint_prismatic, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(slider, 'Slider')
    sim.setObjectPosition(slider, {0, 0, 0.5})
    sim.setObjectOrientation(slider, {0, math.pi / 2, 0})
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(base, 'Base')
    sim.setObjectPosition(base, {-0.5, 0, 0.5})
    sim.setObjectParent(slider, base, true)
    sim.setJointInterval(slider, false, {-3, 6})
    sim.setIntProperty(slider, 'dynCtrlMode', sim.jointdynctrl_force)
    local mass = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(mass, 'Mass')
    sim.setObjectPosition(mass, {0, 0, 0.5})
    sim.setShapeMass(mass, 2)
    sim.setBoolProperty(mass, 'dynamic', true)
    sim.setObjectParent(mass, slider, true)
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'

local kp, kd = 10, 0.5

function sysCall_init() slider = sim.getObject('..') end

function setGains(p, d) kp, kd = p, d end

function sysCall_actuation()
    sim.setJointTargetForce(slider, kp * (1 - sim.getJointPosition(slider)) - kd * sim.getJointVelocity(slider), true)
end
]])
    sim.setObjectAlias(script, 'Control')
    sim.setObjectParent(script, slider, false)
end
]==],
    solve = function(call)
        call('step', {count = 1})
        local variants = {}
        for _, p in ipairs {5, 10, 20} do
            for _, d in ipairs {2, 6, 10, 14} do
                variants[p .. ' ' .. d] = string.format("sim.callScriptFunction('setGains', sim.getObject('/Slider/Control'), %g, %g)", p, d)
            end
        end
        local tried = call('compare_variants', {variants = variants, time = 4, measure = {'/Slider.jointPosition'}}).values.variants
        local best
        for _, variant in ipairs(tried) do
            local _, x = next(variant.quantities)
            local cost = math.abs(x.last - 1) + 10 * math.max(0, x.largest - 1.02)
            if not best or cost < best.cost then best = {cost = cost, name = variant.variant} end
        end
        local p, d = best.name:match('(%S+) (%S+)')
        call('simulation', {action = 'stop'})
        call('write_script', {script = '/Slider/Control', old = 'kp, kd = 10, 0.5', new = string.format('kp, kd = %s, %s', p, d)})
    end,
    check = function(call)
        local rows = call('run_until', {time = 4, watch = {'/Slider.jointPosition'}, rows = 100}).values.samples.rows
        for _, row in ipairs(rows) do if row[2] > 1.05 then return string.format('%g m at %g s', row[2], row[1]) end end
        if math.abs(rows[#rows][2] - 1) > 0.02 then return 'it is at ' .. rows[#rows][2] end
    end,
}
