-- The simulator's side of ros2_stock.sh: that of ros2_peers.py, an object, and an action.
sim = require 'sim'
assert(loadfile(sim.getStringParam(sim.stringparam_scene_path) .. '/ros2_scene.lua'))()

local init, actuation = sysCall_init, sysCall_actuation

function sysCall_init()
    init()
    action = r.createActionServer('/fibonacci', 'example_interfaces/action/Fibonacci',
        function() return r.goal_response.accept_and_execute end,
        function() return r.cancel_response.accept end,
        function(id, goal) goals = {id = id, left = goal.order, sequence = {0, 1}} end)
end

function sysCall_actuation()
    actuation()
    if not goals then return end
    local sequence = goals.sequence
    sequence[#sequence + 1] = sequence[#sequence] + sequence[#sequence - 1]
    goals.left = goals.left - 1
    r.actionServerPublishFeedback(action, goals.id, {sequence = sequence})
    if goals.left <= 1 then
        r.actionServerActionSucceed(action, goals.id, {sequence = sequence})
        goals = nil
    end
end
