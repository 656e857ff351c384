-- A robot from a file, whose joints have to be found.
return {
    task = 'Add the robot of scenes/gripper.urdf to the scene, and open its gripper by 3 cm.',
    arguments = {'scenes/hello.lua'},
    solve = function(call)
        call('load', {path = 'scenes/gripper.urdf', add = true})
        local grip = call('find_objects', {pattern = '*grip', type = 'joint'}).values.objects[1].path
        call('set_properties', {values = {[grip .. '.targetPos'] = 0.03}})
        call('run_until', {['until'] = {joint = {joint = grip, tolerance = 0.002}}, time = 5})
    end,
    check = function(call)
        local found = call('joints').values
        for _, joint in ipairs(found and found.joints or {}) do
            if joint.path:match('/grip$') then
                if math.abs(joint.position - 0.03) > 0.005 then return 'it is at ' .. joint.position end
                return
            end
        end
        return 'there is no gripper'
    end,
}
