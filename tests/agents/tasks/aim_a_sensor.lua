-- A proximity sensor that looks past the wall.
return {
    task = 'The sensor /Eye shall detect the box /Target, but it looks into the void. Turn it (its place stays).',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local eye = sim.createProximitySensor(sim.proximitysensor_ray_subtype, 16, 0, {0, 0, 0, 0, 0, 0, 0, 0}, {0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.01})
    sim.setObjectAlias(eye, 'Eye')
    sim.setObjectPosition(eye, {0, 0, 0.5})
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2})
    sim.setObjectAlias(box, 'Target')
    sim.setObjectPosition(box, {1, 1, 0.5})
    sim.setObjectSpecialProperty(box, sim.objectspecialproperty_detectable)
end
]==],
    solve = function(call)
        -- It looks along its z axis: about y into the plane, then about the vertical.
        call('run_code', {code = [[
local from, to = sim.getObjectPosition(sim.getObject('/Eye')), sim.getObjectPosition(sim.getObject('/Target'))
local angle = math.atan(to[2] - from[2], to[1] - from[1])
local m = sim.buildMatrix({0, 0, 0}, {0, 0, angle})
local down = sim.buildMatrix({0, 0, 0}, {0, math.pi / 2, 0})
local all = sim.multiplyMatrices(m, down)
all[4], all[8], all[12] = table.unpack(from)
sim.setObjectMatrix(sim.getObject('/Eye'), all)
]]})
    end,
    check = function(call)
        local seen = call('run_code', {code = "(sim.checkProximitySensor(sim.getObject('/Eye'), sim.handle_all))"}).text
        if seen:match('^%S+') ~= '1' then return 'it detects nothing: ' .. seen end
        local at = call('get_properties', {items = {'/Eye.position'}}).values.values['/Eye.position']
        if math.abs(at[1]) + math.abs(at[2]) + math.abs(at[3] - 0.5) > 1e-6 then return 'it was moved' end
    end,
}
