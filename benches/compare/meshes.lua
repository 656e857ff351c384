-- What meshes.py compares with other programs, in Swanilda: times in milliseconds, and results that Python checks.
sim = require 'sim'
simConvex = require 'simConvex'
simICP = require 'simICP'
simOpenMesh = require 'simOpenMesh'

local folder = sim.getNamedStringParam('folder')

--- Calls a function some times; the best time and the last result.
local function best(times, f)
    local least, result = math.huge, nil
    for _ = 1, times do
        local begin = sim.getSystemTime()
        result = f()
        least = math.min(least, sim.getSystemTime() - begin)
    end
    return 1000 * least, result
end

local function read(name)
    local file = assert(io.open(folder .. '/' .. name, 'rb'))
    local text, numbers = file:read('a'), {}
    file:close()
    for at = 1, #text, 8 do numbers[#numbers + 1] = string.unpack('<d', text, at) end
    return numbers
end

function sysCall_init()
    local ball
    local time = best(5, function()
        if ball then sim.removeObjects({ball}) end
        ball = sim.importShape(0, folder .. '/ball.stl', 0, 0, 1)
    end)
    print('import', time)
    local points = read('points.f64')
    local time, hull = best(5, function()
        local vertices, indices = simConvex.qhull(points)
        return {vertices, indices}
    end)
    print('hull', time, #hull[1] // 3, #hull[2] // 3)
    sim.exportMesh(4, folder .. '/hull.stl', 0, 1, {hull[1]}, {hull[2]})
    local time, small = best(1, function() return simOpenMesh.decimate(ball, {triangles = 20000}) end)
    local vertices, indices = sim.getShapeMesh(small)
    print('decimation', time, #indices // 3)
    sim.exportMesh(4, folder .. '/small.stl', 0, 1, {vertices}, {indices})
    local function cloud(name)
        local handle = sim.createPointCloud(0.1, 100, 0, 2)
        sim.insertPointsIntoPointCloud(handle, 2, read(name))
        return handle
    end
    local model, template = cloud('model.f64'), cloud('template.f64')
    local time, matrix = best(1, function() return simICP.match(model, template) end)
    print('registration', time, table.unpack(matrix))
end
