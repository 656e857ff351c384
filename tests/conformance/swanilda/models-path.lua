-- topic: modules
-- as: customization
-- passes: 0
-- loops: 30
-- tol: 1e-6
-- spec: models 2; the path module: smoothing 0, closed, orientation modes, virtual distance, removal, shape, trigger
sim = require 'sim'

local function poses(...)
    local t = {}
    for _, p in ipairs{...} do for _, x in ipairs{p[1], p[2], p[3], 0, 0, 0, 1} do t[#t + 1] = x end end
    return t
end

local function block(object, name) return sim.unpackDoubleTable(sim.readCustomStringData(object, name)) end

local function row(list, first, last)
    local t = {}
    for i = first, last do t[#t + 1] = string.format('%.6f', list[i] + 1e-12) end
    return table.concat(t, ' ')
end

local function children(object, type)
    local found, i = {}, 0
    while true do
        local child = sim.getObjectChild(object, i)
        if child < 0 then return found end
        if sim.getObjectType(child) == type then found[#found + 1] = child end
        i = i + 1
    end
end

local function model(points, options, count, smoothing, mode, code)
    local path = sim.createPath(points, options, count, smoothing, mode)
    sim.removeObjects(children(path, sim.sceneobject_script))
    local script = sim.createScript(sim.scripttype_customization, code or "path = require('models.path_customization-2')")
    sim.setObjectParent(script, path)
    sim.initScript(script)
    return path, script
end

local CORNER <const> = poses({0, 0, 0}, {1, 0, 0}, {1, 1, 0})

function sysCall_init()
    local path = model(CORNER, 0, 5, 0)
    local line = block(path, 'PATH')
    for i = 1, 5 do print(row(line, 7 * i - 6, 7 * i - 5)) end
    print(#line, #block(path, 'PATH_X'), row(block(path, 'PATH_X'), 1, 5))
    local closed = model(CORNER, 2, 100, 0)
    line = block(closed, 'PATH')
    print(#block(closed, 'PATHCTRLPTS'), #line, row(line, 1, 3), row(line, 694, 696))
    for mode = 0, 1 do print(row(block(model(poses({0, 0, 0}, {1, 0, 0}), 16, 10, 0, mode), 'PATH'), 4, 7)) end

    channels, channelScript = model(CORNER, 0, 3, 0)
    local point = sim.getObject('./ctrlPt', {proxy = channels})
    local next = sim.getObject('./ctrlPt', {proxy = channels, index = 1})
    sim.writeCustomStringData(next, 'ABC_PATHCTRLPT',
        sim.packTable{index = 2, handle = next, virtualDist = 1, auxChannels = {2, 4, 6, 8}})
    sim.executeScriptString('path.forceFullRebuild = true path.setup()', channelScript)
    local extra = block(channels, 'PATHCTRLPTS_X')
    print(row(extra, 1, 10))
    -- Of a length of twice the root of two, the middle is the second point.
    print(row(block(channels, 'PATH'), 8, 9), row(block(channels, 'PATH_X'), 6, 10))

    local code = [[
    path = require('path_customization')
    function path.shaping(points, closed, up) print('shaping', #points // 7, closed, up[3]) return sim.createPrimitiveShape(3, {0.1, 0.1, 0.1}) end
    function path.refreshTrigger(handles, points, info) print('trigger', #handles, #points // 7, info.pointCnt) end
    ]]
    shaped, shapedScript = model(CORNER, 4, 20, 1, 0, code)
    print(sim.getObjectAlias(sim.getObject('./shape', {proxy = shaped})))
    print(sim.executeScriptString('return #path.setup()', shapedScript))
    print(_S.path, sim.executeScriptString('return _S.path == path and path.model == sim.getObject("..")', shapedScript))
    -- 64 hides nothing, 32 hides the line.
    for _, options in ipairs{64, 32} do
        local _, script = model(CORNER, options, 5, 0)
        print('line', sim.executeScriptString('return path.line ~= nil', script))
    end
    short = model(poses({0, 0, 0}, {1, 0, 0}), 0, 10)
end

local passes = 0

function sysCall_nonSimulation()
    passes = passes + 1
    if passes == 2 then
        print('points', sim.isHandle(short))
        sim.removeObjects{sim.getObject('./ctrlPt', {proxy = short})}
    elseif passes == 4 then
        print('one removed', sim.isHandle(short))
        local copies = sim.copyPasteObjects({sim.getObject('./ctrlPt', {proxy = channels}), sim.getObject('./ctrlPt', {proxy = channels, index = 1})}, 0)
        print('copied', #copies, sim.getObjectParent(copies[1]) == channels, #block(channels, 'PATHCTRLPTS') // 7)
        local order = {}
        for i = 0, 4 do order[i + 1] = sim.unpackTable(sim.readCustomStringData(sim.getObjectChild(channels, i), 'ABC_PATHCTRLPT') or sim.packTable{}).index or '-' end
        print(order)
        sim.setObjectPosition(sim.getObject('./ctrlPt', {proxy = shaped}), {0, 0, 1}, shaped)
    elseif passes == 6 then
        print(sim.getObjectInt32Param(copies or sim.getObject('./ctrlPt', {proxy = shaped}), sim.objintparam_visibility_layer))
        sim.quitSimulator()
    end
end
