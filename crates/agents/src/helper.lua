--[[
What tools need of the simulator in Lua: code that a client sends, quantities that are watched, conditions, rows of the scene.

It lives in the sandbox as a module that scripts do not see by name.
]]

local sim = require 'sim'
local M = {}

local OWN_HANDLES = {app = sim.handle_app, scene = sim.handle_scene}

--- Handle of an object by its handle (12 or `#12`), its path, or its alias.
function M.find(ref)
    if OWN_HANDLES[ref] then return OWN_HANDLES[ref] end
    ref = math.tointeger(tostring(ref):match('^#(%d+)$')) or ref
    if math.type(ref) == 'integer' then
        if not sim.isHandle(ref) then error('there is no object with handle ' .. ref, 0) end
        return ref
    end
    local path = tostring(ref)
    if path:sub(1, 1) ~= '/' then path = '/' .. path end
    local handle = sim.getObject(path, {noError = true})
    if handle == -1 then error('there is no object ' .. path, 0) end
    return handle
end

local function traced(message)
    return {text = tostring(message), trace = debug.traceback('', 2)}
end

--- Runs code; what it returns as texts, or its error.
function M.run(code, name)
    local chunk, message = load('return ' .. code, name)
    if not chunk then chunk, message = load(code, name) end
    if not chunk then return {error = message, syntax = true} end
    local results = table.pack(xpcall(chunk, traced))
    if not results[1] then return {error = results[2].text, trace = results[2].trace} end
    local texts = {}
    for i = 2, results.n do texts[#texts + 1] = getAsString(results[i]) end
    return {results = texts}
end

--- Why a text is no Lua code; nil if it is.
function M.syntax(code, name)
    local chunk, message = load(code, name)
    return not chunk and message or nil
end

-- What all objects have beside their properties: in the frame of the world.
local placed = {
    position = {read = function(h) return sim.getObjectPosition(h) end, write = function(h, v) sim.setObjectPosition(h, v) end},
    orientation = {read = function(h) return sim.getObjectOrientation(h) end, write = function(h, v) sim.setObjectOrientation(h, v) end},
    linearVelocity = {read = function(h) return (sim.getObjectVelocity(h)) end},
    angularVelocity = {read = function(h) return (select(2, sim.getObjectVelocity(h))) end},
}

local function read(handle, name)
    if placed[name] and handle >= 0 then return placed[name].read(handle) end
    return sim.getProperty(handle, name)
end

local function write(handle, name, value)
    if not (placed[name] and handle >= 0) then return sim.setProperty(handle, name, value) end
    if not placed[name].write then error(name .. ' can only be read; set initLinearVelocity or initAngularVelocity, or use sim.addForceAndTorque in run_code', 0) end
    placed[name].write(handle, value)
end

-- `/a[1]/b.position[3]`, `#12.mass`, `scene.gravity`: handle, name of the property, index. Aliases may contain dots.
local function split(text)
    local first = text:match('^[^/]*') == '' and (text:match('^.*/()') or 1) or 1
    local at = text:find('.', first, true)
    while at do
        local known, handle = pcall(M.find, text:sub(1, at - 1))
        if known then
            local name, index = text:sub(at + 1):match('^(.-)%[(%d+)%]$')
            return handle, name or text:sub(at + 1), tonumber(index)
        end
        at = text:find('.', at + 1, true)
    end
    local object = text:match('^(.*)%.[^.]*$')
    if object then M.find(object) end
    error('a property is written PATH.NAME, such as /Cuboid.mass', 0)
end

local function isProperty(text)
    return text:sub(1, 1) == '/' or text:match('^#%d+%.') or text:match('^scene%.') or text:match('^app%.')
end

local function propertyReader(text)
    local handle, name, index = split(text)
    if not index then return function() return read(handle, name) end end
    return function()
        local value = read(handle, name)
        return type(value) == 'table' and value[index] or nil
    end
end

local function reader(text)
    if isProperty(text) then return propertyReader(text) end
    local chunk, message = load('return ' .. text, 'expression')
    if not chunk then error(message, 0) end
    return chunk
end

--- Handle and name of a property.
function M.owner(text)
    local handle, name = split(text)
    return {handle = handle, name = name}
end

--- Values of properties by their texts: pairs of whether it is there, and value or error.
function M.get(texts)
    local values = {}
    for i, text in ipairs(texts) do
        local ok, value = pcall(function() return propertyReader(text)() end)
        if ok and value == nil then ok, value = false, 'it has no value' end
        values[i] = {ok = ok, value = ok and value or nil, error = not ok and tostring(value) or nil}
    end
    return values
end

--- Sets one property; its error, or nil.
function M.set(text, value)
    local ok, message = pcall(function()
        local handle, name, index = split(text)
        if index then
            local all = read(handle, name)
            all[index] = value
            value = all
        end
        write(handle, name, value)
    end)
    return not ok and tostring(message) or nil
end

--- Whether lengths, not angles, are meant where a property of a joint may be either; nil for what is no joint.
function M.slides(text)
    local ok, handle = pcall(split, text)
    if not ok or handle < 0 or sim.getObjectType(handle) ~= sim.sceneobject_joint then return nil end
    return sim.getJointType(handle) == sim.joint_prismatic
end

local readers, conditions = {}, {}

--- Chooses the quantities that `sample` reads; the error of the first that cannot be read now, with its number.
function M.watch(texts)
    readers = {}
    for i, text in ipairs(texts) do
        local ok, read = pcall(reader, text)
        if not ok then return {number = i, error = tostring(read)} end
        local able, value = pcall(read)
        if not able then return {number = i, error = tostring(value)} end
        readers[i] = read
    end
end

local function plain(value)
    local kind = type(value)
    if kind == 'number' or kind == 'boolean' or kind == 'string' then return value end
    if kind == 'table' and #value > 0 and #value <= 16 then
        for _, part in ipairs(value) do if type(part) ~= 'number' then return getAsString(value) end end
        return {table.unpack(value)}
    end
    if kind == 'nil' then return 'nil' end
    return getAsString(value)
end

function M.sample()
    local values = {}
    for i, read in ipairs(readers) do
        local ok, value = pcall(read)
        if ok then values[i] = plain(value) else values[i] = 'error: ' .. tostring(value) end
    end
    return values
end

local makers = {}

function makers.collision(pair)
    local a, b = M.find(pair[1]), M.find(pair[2])
    return function() return sim.checkCollision(a, b) == 1 end, 'collision of ' .. pair[1] .. ' and ' .. pair[2]
end

local function distance(a, b)
    local _, data = sim.checkDistance(a, b, 0)
    return data[7]
end

function makers.distance(what)
    local a, b = M.find(what.objects[1]), M.find(what.objects[2])
    local names = what.objects[1] .. ' and ' .. what.objects[2]
    if not (what.below or what.above) then error('give `below` or `above`, in metres', 0) end
    if what.below then
        return function() return distance(a, b) < what.below end, 'the distance of ' .. names .. ' is below ' .. what.below .. ' m'
    end
    return function() return distance(a, b) > what.above end, 'the distance of ' .. names .. ' is above ' .. what.above .. ' m'
end

local function signal(name)
    for _, get in ipairs {sim.getStringSignal, sim.getInt32Signal, sim.getFloatSignal} do
        local ok, value = pcall(get, name)
        if ok and value ~= nil then return value end
    end
    local ok, value = pcall(sim.getProperty, sim.handle_scene, 'signal.' .. name)
    if ok then return value end
end

function makers.signal(what)
    return function()
        local value = signal(what.name)
        return value ~= nil and (what.value == nil or value == what.value)
    end, 'the signal ' .. what.name .. (what.value == nil and ' is there' or ' is ' .. tostring(what.value))
end

function makers.joint(what)
    local joint = M.find(what.joint)
    local goal = function() return what.position or sim.getJointTargetPosition(joint) end
    local tolerance = what.tolerance or 0.01
    return function() return math.abs(sim.getJointPosition(joint) - goal()) <= tolerance end,
        string.format('%s is within %g of %g', what.joint, tolerance, goal())
end

makers['lua'] = function(text)
    local chunk, message = load('return ' .. text, 'condition')
    if not chunk then error(message, 0) end
    return chunk, text
end

--- Sets what `check` looks for: a map from kinds to their parameters. An error, or nil.
function M.expect(wanted)
    conditions = {}
    for kind, what in pairs(wanted) do
        local ok, holds, text = pcall(makers[kind], what)
        if not ok then return kind .. ': ' .. tostring(holds) end
        conditions[#conditions + 1] = {holds = holds, text = text, kind = kind}
    end
    table.sort(conditions, function(a, b) return a.kind < b.kind end)
end

--- The condition that holds now, or the error of one.
function M.check()
    for _, condition in ipairs(conditions) do
        local ok, holds = pcall(condition.holds)
        if not ok then return {error = condition.kind .. ': ' .. tostring(holds)} end
        if holds then return {met = condition.text} end
    end
end

local TYPES = {
    [sim.sceneobject_shape] = 'shape', [sim.sceneobject_joint] = 'joint', [sim.sceneobject_graph] = 'graph',
    [sim.sceneobject_camera] = 'camera', [sim.sceneobject_dummy] = 'dummy', [sim.sceneobject_proximitysensor] = 'proximity sensor',
    [sim.sceneobject_visionsensor] = 'vision sensor', [sim.sceneobject_forcesensor] = 'force sensor',
    [sim.sceneobject_light] = 'light', [sim.sceneobject_octree] = 'octree', [sim.sceneobject_pointcloud] = 'point cloud',
    [sim.sceneobject_script] = 'script',
}

local function numbers(list, unit)
    local texts = {}
    for i, value in ipairs(list) do texts[i] = string.format('%.4g', math.abs(value) < 5e-7 and 0 or value) end
    return (#texts == 1 and texts[1] or '(' .. table.concat(texts, ', ') .. ')') .. ' ' .. unit
end

local describe = {}

function describe.shape(handle)
    local size = sim.getShapeBB(handle)
    local text = 'size ' .. numbers(size, 'm')
    if sim.getBoolProperty(handle, 'dynamic') then text = text .. ', dynamic, mass ' .. numbers({sim.getShapeMass(handle)}, 'kg')
    elseif sim.getBoolProperty(handle, 'respondable') then text = text .. ', static' 
    else text = text .. ', no contacts' end
    return text
end

local MODES = {[0] = 'kinematic', [sim.jointmode_dynamic] = 'dynamic', [sim.jointmode_dependent] = 'dependent'}
local CONTROLS = {
    [sim.jointdynctrl_free] = 'free', [sim.jointdynctrl_force] = 'force', [sim.jointdynctrl_velocity] = 'velocity',
    [sim.jointdynctrl_position] = 'position', [sim.jointdynctrl_spring] = 'spring', [sim.jointdynctrl_callback] = 'callback',
}
local KINDS = {[sim.joint_revolute] = 'revolute', [sim.joint_prismatic] = 'prismatic', [sim.joint_spherical] = 'spherical'}

local function control(joint)
    local mode = sim.getJointMode(joint)
    if mode ~= sim.jointmode_dynamic then return MODES[mode] or tostring(mode) end
    return (CONTROLS[sim.getIntProperty(joint, 'dynCtrlMode')] or '?') .. ' control'
end

local function unit(joint)
    return sim.getJointType(joint) == sim.joint_prismatic and 'm' or 'rad'
end

function describe.joint(handle)
    local kind = sim.getJointType(handle)
    if kind == sim.joint_spherical then return 'spherical' end
    return KINDS[kind] .. ', ' .. control(handle) .. ', at ' .. numbers({sim.getJointPosition(handle)}, unit(handle))
end

describe['vision sensor'] = function(handle)
    local size = sim.getVisionSensorRes(handle)
    return size[1] .. 'x' .. size[2] .. ' pixels'
end

function describe.script(handle)
    local code = sim.getStringProperty(handle, 'code')
    local _, lines = code:gsub('\n', '')
    local kind = sim.getIntProperty(handle, 'scriptType')
    local names = {[sim.scripttype_simulation] = 'simulation', [sim.scripttype_customization] = 'customization', [sim.scripttype_addon] = 'add-on'}
    return (names[kind] or 'kind ' .. kind) .. ' script, ' .. lines + 1 .. ' lines'
end

local function row(handle)
    local kind = TYPES[sim.getObjectType(handle)] or 'other'
    local known, text = pcall(describe[kind] or function() return '' end, handle)
    local place = kind ~= 'script' and sim.getObjectPosition(handle) or {}
    return {
        handle = handle, parent = sim.getObjectParent(handle), alias = sim.getObjectAlias(handle), kind = kind,
        path = sim.getObjectAlias(handle, 2), text = known and text or '', position = place,
    }
end

--- Objects below one, itself first, or all; parents come before their children.
function M.rows(base)
    local rows = {}
    local handles = sim.getObjectsInTree(base and M.find(base) or sim.handle_scene)
    for i, handle in ipairs(handles) do rows[i] = row(handle) end
    return rows
end

--- What joints do: of all, or below an object.
function M.joints(base)
    local rows = {}
    local handles = sim.getObjectsInTree(base and M.find(base) or sim.handle_scene, sim.sceneobject_joint)
    for _, handle in ipairs(handles) do
        if sim.getJointType(handle) ~= sim.joint_spherical then
            local mode = control(handle)
            local cyclic, interval = sim.getJointInterval(handle)
            local lies = sim.getJointMode(handle) == sim.jointmode_dynamic and sim.getSimulationState() ~= sim.simulation_stopped
                and sim.getIntProperty(handle, 'dynamicFlag') & 4 == 0
            rows[#rows + 1] = {
                path = sim.getObjectAlias(handle, 2), mode = mode, idle = lies or nil, unit = unit(handle),
                position = sim.getJointPosition(handle), velocity = sim.getJointVelocity(handle),
                force = sim.getJointForce(handle) or 0,
                limit = mode:find('control') and mode ~= 'free control' and sim.getJointTargetForce(handle) or nil,
                target = mode:find('position') and sim.getJointTargetPosition(handle)
                    or mode:find('velocity') and sim.getJointTargetVelocity(handle) or nil,
                low = not cyclic and interval[1] or nil, high = not cyclic and interval[1] + interval[2] or nil,
            }
        end
    end
    return rows
end

--- Replaces the text of a script, which starts again if it runs.
function M.write(ref, code)
    local handle = M.find(ref)
    sim.setStringProperty(handle, 'code', code)
    local kind = sim.getIntProperty(handle, 'scriptType')
    if kind == sim.scripttype_customization or sim.getSimulationState() ~= sim.simulation_stopped then sim.initScript(handle) end
    return sim.getObjectAlias(handle, 2)
end

--- Adds a script to an object or to the scene.
function M.add(kind, code, alias, parent)
    local at = parent and M.find(parent)
    local handle = sim.createScript(kind == 'simulation' and sim.scripttype_simulation or sim.scripttype_customization, code)
    sim.setObjectAlias(handle, alias or 'Script')
    if at then sim.setObjectParent(handle, at, false) end
    if kind ~= 'simulation' then sim.initScript(handle) end
    return sim.getObjectAlias(handle, 2)
end

function M.path(handle)
    return sim.getObjectAlias(handle, 2)
end

--- Handles of the scripts in Lua of the scene.
function M.scripts()
    local found = {}
    for _, handle in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.sceneobject_script)) do
        if sim.getStringProperty(handle, 'language') == 'lua' then found[#found + 1] = handle end
    end
    return found
end

-- An error of a call from outside would be one of the sandbox's: it is a result instead.
local guarded = {}
for name, f in pairs(M) do
    guarded[name] = function(...)
        local results = table.pack(pcall(f, ...))
        if not results[1] then return {failed = tostring(results[2])} end
        return table.unpack(results, 2, results.n)
    end
end

package.loaded.swanilda_agents = guarded
