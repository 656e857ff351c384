-- What generators of properties draw, over many cases.

local sim = require('sim')
local t = require('swanilda.test')

t.property('numbers are within their bounds', { cases = 200 }, function(g)
    local x, n = g.float(-2, 3), g.integer(4, 9)
    assert.is_true(x >= -2 and x <= 3)
    assert.is_true(n >= 4 and n <= 9 and math.type(n) == 'integer')
    assert.are.equal('number', type(g.seed()))
end)

t.property('collections have the lengths that were asked for', { cases = 200 }, function(g)
    local list = g.list(function(i) return i end, { min = 2, max = 5 })
    assert.is_true(#list >= 2 and #list <= 5)
    for i, element in ipairs(list) do assert.are.equal(i, element) end
    local some = g.subset { 'a', 'b', 'c' }
    assert.are.equal(table.concat(some), ('abc'):gsub('[^' .. table.concat(some) .. '-]', ''))
    assert.is_truthy(('ab'):find(g.choice { 'a', 'b' }))
end)

t.property('poses have unit quaternions', { cases = 100 }, function(g)
    local pose = g.pose { x = { -1, 1 }, z = 0.5, roll = { -3, 3 }, pitch = { -1, 1 }, yaw = { -3, 3 } }
    assert.are.equal(7, #pose)
    assert.near(1, pose[4] ^ 2 + pose[5] ^ 2 + pose[6] ^ 2 + pose[7] ^ 2, 1e-12)
    assert.are.equal(0.5, pose[3])
    local dummy = sim.createDummy(0.01)
    sim.setObjectPose(dummy, pose)
end)

-- Against the rotation that the angles say: yaw turns the x axis within the plane.
t.property('yaw turns about z', { cases = 50 }, function(g)
    local yaw = g.float(-3, 3)
    local pose = g.pose { yaw = yaw }
    local matrix = sim.poseToMatrix(pose)
    assert.near(math.cos(yaw), matrix[1], 1e-9)
    assert.near(math.sin(yaw), matrix[5], 1e-9)
end)

t.property('obstacles stay clear of discs', { cases = 50 }, function(g)
    local handles, obstacles = g.obstacles { count = { 0, 4 }, x = { -1, 1 }, y = { -1, 1 }, clear = { { 0, 0, 0.4 } } }
    assert.are.equal(#obstacles, #handles)
    for i, handle in ipairs(handles) do
        local place = sim.getObjectPosition(handle)
        assert.near(obstacles[i].x, place[1], 1e-6)
        assert.is_true(math.sqrt(place[1] ^ 2 + place[2] ^ 2) > 0.4)
    end
end)

-- Cases are undone: none sees what another one has left.
local count = 0
t.property('cases do not see each other', { cases = 30 }, function(g)
    assert.are.equal(0, count)
    assert.are.equal(-1, sim.getObject('/left', { noError = true }))
    sim.setObjectAlias(sim.createDummy(0.01), 'left')
    count = count + g.integer(1, 5)
    t.run_for(0.2)
    assert.near(0.2, t.time(), 0.06)
end)

t.property('what does not fit is discarded', { cases = 50 }, function(g)
    local x = g.float(0, 1)
    g.assume(x > 0.5)
    assert.is_true(x > 0.5)
end)
