--[[
Chains shown in the scene by drawing objects, and Jacobians as text.
]]

local sim = require 'sim'

local overlays = {}

local known = {} -- by number: environment and drawing objects
local ofGroups = {} -- by environment and group: numbers
local last = 0

local LINE <const>, AXIS <const> = {0.2, 0.6, 1}, {1, 0.5, 0}
local AXIS_LENGTH <const> = 0.05

-- From below the base to the tip.
local function chain(simIK, env, tip, base)
    local objects, object = {}, tip
    while object and object ~= -1 and object ~= base do -- nil: an error that is switched off
        table.insert(objects, 1, object)
        object = simIK.getObjectParent(env, object)
    end
    return objects
end

local function addAxis(simIK, env, joint, axes)
    if simIK.getJointType(env, joint) == simIK.jointtype_spherical then return end
    local m = simIK.getObjectMatrix(env, joint)
    local function point(side) return m[4] + side * m[3], m[8] + side * m[7], m[12] + side * m[11] end
    local x, y, z = point(-AXIS_LENGTH)
    local u, v, w = point(AXIS_LENGTH)
    sim.addDrawingObjectItem(axes, {x, y, z, u, v, w})
end

--- Number of a new overlay.
function overlays.create(simIK, env, tip, base)
    local objects = chain(simIK, env, tip, base)
    local lines = sim.addDrawingObject(sim.drawing_lines, 2, 0, -1, math.max(1, #objects), LINE)
    local axes = sim.addDrawingObject(sim.drawing_lines, 4, 0, -1, math.max(1, #objects), AXIS)
    local before = base ~= -1 and simIK.getObjectPose(env, base) or nil
    for _, object in ipairs(objects) do
        local pose = simIK.getObjectPose(env, object)
        if before then sim.addDrawingObjectItem(lines, {before[1], before[2], before[3], pose[1], pose[2], pose[3]}) end
        before = pose
        if simIK.getObjectType(env, object) == simIK.objecttype_joint then addAxis(simIK, env, object, axes) end
    end
    last = last + 1
    known[last] = {env = env, lines, axes}
    return last
end

function overlays.erase(number)
    local overlay = known[number] or error('overlay does not exist.', 3)
    known[number] = nil
    for _, drawing in ipairs(overlay) do sim.removeDrawingObject(drawing) end
end

--- Removes the overlays of an environment.
function overlays.forget(env)
    local numbers = {}
    for number, overlay in pairs(known) do
        if overlay.env == env then numbers[#numbers + 1] = number end
    end
    table.sort(numbers)
    for _, number in ipairs(numbers) do overlays.erase(number) end
    ofGroups[env] = nil
end

--- Shows the tips of a group anew.
function overlays.ofGroup(simIK, env, group)
    local shown = ofGroups[env] or {}
    ofGroups[env] = shown
    for _, number in ipairs(shown[group] or {}) do
        if known[number] then overlays.erase(number) end
    end
    shown[group] = {}
    local index, object = 0, simIK.getObjects(env, 0)
    while object and object ~= -1 do
        local isTip = simIK.getObjectType(env, object) == simIK.objecttype_dummy
            and pcall(simIK.getElementFlags, env, group, object | simIK.handleflag_tipdummy)
        if isTip then table.insert(shown[group], overlays.create(simIK, env, object, -1)) end
        index = index + 1
        object = simIK.getObjects(env, index)
    end
end

---------------------------------------------------------------- text

local function numbers(value) return type(value.data) == 'function' and value:data() or value end

--- A Jacobian, a line for each row, with the error behind it.
function overlays.text(data)
    local jacobian, errors = numbers(data.jacobian), numbers(data.e)
    local width = #errors > 0 and #jacobian // #errors or 0
    local lines = {('Jacobian of group %s:'):format(data.groupIndex or '?')}
    for row, value in ipairs(errors) do
        local cells = {}
        for i = 1, width do cells[i] = ('%9.5f'):format(jacobian[(row - 1) * width + i]) end
        lines[#lines + 1] = table.concat(cells, ' ') .. (' | %9.5f'):format(value)
    end
    return table.concat(lines, '\n')
end

return overlays
