--[[
Shared by utils.lua: the functions that old scripts find as globals once they required `utils`, by name.
]]

local sim = _quietRequire 'sim'
local M = {}

---------------------------------------------------------------- checks

local function fail(text, level) error(text, (level or 1) + 2) end

function M.asserttype(value, wanted, message)
    local kind = type(value)
    if kind ~= wanted then fail(message or ('expected a %s, but got a %s'):format(wanted, kind)) end
end

for _, kind in ipairs{'number', 'string', 'table'} do
    M['assert' .. kind] = function(value, message)
        if type(value) ~= kind then fail(message or ('expected a %s, but got a %s'):format(kind, type(value))) end
    end
end

function M.assertmember(owner, name, kind)
    local value = type(owner) == 'table' and owner[name]
    if value == nil then fail(('missing member %s'):format(tostring(name))) end
    if kind and type(value) ~= kind then fail(('member %s: expected a %s, but got a %s'):format(tostring(name), kind, type(value))) end
end

---------------------------------------------------------------- objects

function M.getObjectsWithTag(tag, onlyModels) return sim.getObjectsWithTag(tag, onlyModels) end

local function handleOf(name) return simGetObjectHandle(tostring(name) .. '@silentError') end

--- Handle of an object by its old name, -1 if there is none.
function M.getObjectHandle_noError(name)
    local ok, handle = pcall(handleOf, name)
    return ok and handle or -1
end

--- The same, of exactly that name.
function M.getObjectHandle_noErrorNoSuffixAdjustment(name)
    local text = tostring(name)
    return M.getObjectHandle_noError(text:find '#' and text or text .. '#')
end

--- A box without a lid, of five cuboids in one shape.
-- @param size outer lengths
-- @param inside thickness of the walls
-- @param below thickness of the floor
function M.createOpenBox(size, inside, below, density, inertiaFactor, dynamic, respondable, colour)
    local x, y, z = table.unpack(size)
    local walls = {
        {{x, y, below}, {0, 0, (below - z) / 2}}, {{inside, y, z - below}, {(inside - x) / 2, 0, below / 2}},
        {{inside, y, z - below}, {(x - inside) / 2, 0, below / 2}}, {{x - 2 * inside, inside, z - below}, {0, (inside - y) / 2, below / 2}},
        {{x - 2 * inside, inside, z - below}, {0, (y - inside) / 2, below / 2}},
    }
    local parts = {}
    for i, wall in ipairs(walls) do
        parts[i] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, wall[1], 0)
        sim.setObjectPosition(parts[i], wall[2])
        if colour then sim.setShapeColor(parts[i], nil, sim.colorcomponent_ambient_diffuse, colour) end
    end
    local box = sim.groupShapes(parts)
    if density then sim.computeMassAndInertia(box, density) end
    if inertiaFactor and inertiaFactor ~= 1 then
        local inertia, frame = sim.getShapeInertia(box)
        for i = 1, #inertia do inertia[i] = inertia[i] * inertiaFactor end
        sim.setShapeInertia(box, inertia, frame)
    end
    sim.setBoolProperty(box, 'dynamic', dynamic and true or false)
    sim.setBoolProperty(box, 'respondable', respondable and true or false)
    return box
end

---------------------------------------------------------------- models that are scaled

-- Sensors, cameras and the like have one size only.
local function fits(object, x, y, z)
    local kind = sim.getObjectType(object)
    local isFree = kind == sim.sceneobject_shape or kind == sim.sceneobject_joint or kind == sim.sceneobject_dummy
    return isFree or x == y and y == z
end

function M.canScaleModelNonIsometrically(model, x, y, z)
    for _, object in ipairs(sim.getObjectsInTree(model)) do
        if not fits(object, x, y, z) then return false end
    end
    return true
end

--- Scales a model along its axes: shapes where their axes are those of the model, and all positions.
function M.scaleModelNonIsometrically(model, x, y, z)
    local scale = {x, y, z}
    for _, object in ipairs(sim.getObjectsInTree(model)) do
        local pose = sim.getObjectPose(object, model)
        local matrix = sim.poseToMatrix({0, 0, 0, pose[4], pose[5], pose[6], pose[7]})
        local own = {}
        for axis = 1, 3 do
            -- How much a unit along this axis of the object grows.
            local sum = 0
            for row = 1, 3 do sum = sum + (matrix[4 * row - 4 + axis] * scale[row]) ^ 2 end
            own[axis] = math.sqrt(sum)
        end
        if sim.getObjectType(object) == sim.sceneobject_shape then sim.scaleObject(object, own[1], own[2], own[3]) end
        if object ~= model then
            for axis = 1, 3 do pose[axis] = pose[axis] * scale[axis] end
            sim.setObjectPose(object, pose, model)
        end
    end
end

---------------------------------------------------------------- code, windows

--- Runs Lua text.
function M.executeCode(code)
    local chunk, message = load(code)
    if not chunk then return false, message end
    return pcall(chunk)
end

--- Runs a file of the simulator's or of the scene's folder.
-- @param command Lua text to run before it
function M.include(path, command)
    return sim.include(path, command)
end

--- The bytes of a text.
function M.stringToArray(text)
    local bytes = {}
    for i = 1, #text do bytes[i] = text:byte(i) end
    return bytes
end

--- Fills a combo box, all or those that are not in `exceptions`, and selects one.
-- @param items tables of a text and a value
function M.customUi_populateCombobox(ui, id, items, exceptions, current, sort, additional)
    local excluded, shown, texts = {}, {}, {}
    for _, text in ipairs(exceptions or {}) do excluded[text] = text ~= current end
    for _, item in ipairs(items) do
        if not excluded[item[1]] then shown[#shown + 1] = item end
    end
    if sort then table.sort(shown, function(a, b) return a[1] < b[1] end) end
    for i, item in ipairs(additional or {}) do table.insert(shown, i, item) end
    local selected = 0
    for i, item in ipairs(shown) do
        texts[i] = item[1]
        if item[1] == current then selected = i - 1 end
    end
    _quietRequire('simUI').setComboboxItems(ui, id, texts, selected)
    return shown, selected
end

---------------------------------------------------------------- additions to the standard libraries

local text

local function keyText(key)
    if type(key) == 'string' and key:match '^[_%a][_%w]*$' then return key end
    return '[' .. text(key) .. ']'
end

local function tableText(list)
    local parts, known = {}, {}
    for i, value in ipairs(list) do
        parts[i], known[i] = text(value), true
    end
    local keys = {}
    for key in pairs(list) do
        if not known[key] then keys[#keys + 1] = key end
    end
    table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
    for _, key in ipairs(keys) do parts[#parts + 1] = keyText(key) .. '=' .. text(list[key]) end
    return '{' .. table.concat(parts, ',') .. '}'
end

function text(value)
    if type(value) == 'string' then return '"' .. value:gsub('[\\"\n]', {['\\'] = '\\\\', ['"'] = '\\"', ['\n'] = '\\n'}) .. '"' end
    return type(value) == 'table' and tableText(value) or tostring(value)
end

local function split(line, separator)
    local parts, start = {}, 1
    separator = separator or ','
    while true do
        local first, last = line:find(separator, start, true)
        parts[#parts + 1] = line:sub(start, (first or 0) - 1)
        if not first then return parts end
        start = last + 1
    end
end

local ADDITIONS <const> = {
    table = {val_to_str = text, key_to_str = keyText, tostring = tableText},
    math = {
        hypotn = function(...)
            local sum = 0
            for _, x in ipairs{...} do sum = sum + x * x end
            return math.sqrt(sum)
        end,
    },
    string = {
        formatex = function(format, ...)
            local values = table.pack(...)
            for i = 1, values.n do
                if type(values[i]) == 'table' then values[i] = tableText(values[i]) end
            end
            return format:format(table.unpack(values, 1, values.n))
        end,
        split = split,
        splitlines = function(lines) return split(lines, '\n') end,
    },
}

--- Adds functions to the script's `table`, `string` and `math`; those it has stay.
for library, functions in pairs(ADDITIONS) do
    local target = rawget(_G, library)
    for name, f in pairs(type(target) == 'table' and functions or {}) do
        if target[name] == nil then target[name] = f end
    end
end

return M
