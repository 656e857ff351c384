--[[
Spawning by the standard simulation interfaces of ROS 2: robots and models of files or texts become entities. Internal.
]]

local sim = require('sim')
local lfs = require('lfs')
local results = require('remote.ros2.results')
local entities = require('remote.ros2.entities')

local M = {FORMATS = {'urdf', 'sdf', 'mjcf', 'ttm'}}

local NAME_NOT_UNIQUE <const>, NAME_INVALID <const>, UNSUPPORTED_FORMAT <const>, NO_RESOURCE <const> = 101, 102, 103, 104
local NAMESPACE_INVALID <const>, PARSE_ERROR <const>, INVALID_POSE <const>, SPAWN_FAILED <const> = 105, 106, 109, 150

local spawned = {} -- handles

---------------------------------------------------------------- resources

local ENDINGS <const> = {urdf = 'urdf', sdf = 'sdf', xml = 'mjcf', mjcf = 'mjcf', ttm = 'ttm'}
local ELEMENTS <const> = {robot = 'urdf', sdf = 'sdf', mujoco = 'mjcf'}

--- The file of a URI: `file:///a/b.urdf`, or a path.
function M.fileOf(uri) return (uri:gsub('^file://', '')) end

--- A file with that text and ending, which the caller removes.
function M.temporary(text, ending)
    local name = os.tmpname()
    os.remove(name)
    name = name .. '.' .. ending
    local file = assert(io.open(name, 'wb'))
    file:write(text)
    file:close()
    return name
end

local function formatOfText(text)
    for element in text:gmatch('<(%a[%w_]*)') do return ELEMENTS[element] end
end

-- The file to load, and the file to remove afterwards; nil with a code and the reason.
local function located(resource)
    local text = resource.resource_string
    if text ~= '' then
        local format = formatOfText(text)
        if not format then return nil, UNSUPPORTED_FORMAT, 'the text is neither URDF, SDF nor MJCF' end
        local file = M.temporary(text, format == 'mjcf' and 'xml' or format)
        return file, file
    end
    if resource.uri == '' then return nil, NO_RESOURCE, 'a URI or a text is needed' end
    local file = M.fileOf(resource.uri)
    if not ENDINGS[file:match('%.(%w+)$') or ''] then
        return nil, UNSUPPORTED_FORMAT, ("'%s' is no file .urdf, .sdf, .xml (MJCF) or .ttm"):format(resource.uri)
    end
    return file
end

---------------------------------------------------------------- one entity

local function isNamespace(text) return text == '' or text:find('^/?%a[%w_]*[%w_/]*$') ~= nil and not text:find('//') end

-- A name that no entity has, from that one.
local function unique(name)
    local candidate, number = name, 0
    while entities.find(candidate) do
        number = number + 1
        candidate = name .. '_' .. number
    end
    return candidate
end

local function stem(resource)
    local name = resource.uri:match('([^/]+)%.%w+$') or resource.resource_string:match('name%s*=%s*["\']([%w_]+)')
    return (name or 'entity'):gsub('[^%w_]', '_')
end

-- The name it gets; nil with a code and the reason.
local function nameFor(request)
    local name = request.name
    if name == '' then
        if request.allow_renaming then return unique(stem(request.entity_resource)) end
        return nil, NAME_INVALID, 'a name is needed, or allow_renaming'
    end
    if not name:find('^%a[%w_]*$') then return nil, NAME_INVALID, ("'%s' is no name: letters, digits and _"):format(name) end
    if not entities.find(name) then return name end
    if request.allow_renaming then return unique(name) end
    return nil, NAME_NOT_UNIQUE, ("there is an entity '%s' already"):format(name)
end

--- Gives a robot its topics; the add-on sets it.
function M.attach() end

-- Loads and places an entity; nil and why there is none.
local function load(file, name, pose, namespace)
    local ok, base = pcall(sim.loadModel, file)
    if not ok then return nil, results.reason(base) end
    sim.setObjectAlias(base, name)
    sim.setObjectPose(base, pose)
    if namespace then sim.setStringProperty(base, 'customData.ros2Namespace', namespace) end
    M.attach(base, file, namespace)
    return base
end

local function failed(code, message)
    local response = results.failed(code, message)
    response.entity_name = ''
    return response
end

function M.spawn(request)
    local name, code, reason = nameFor(request)
    if not name then return failed(code, reason) end
    if not isNamespace(request.entity_namespace) then
        return failed(NAMESPACE_INVALID, ("'%s' is no namespace"):format(request.entity_namespace))
    end
    local stamped = request.initial_pose
    local pose, wrong = entities.pose(stamped.pose, stamped.header.frame_id)
    if not pose then return failed(INVALID_POSE, wrong) end
    local file, codeOrTemporary, why = located(request.entity_resource)
    if not file then return failed(codeOrTemporary, why) end
    local namespace = request.entity_namespace ~= '' and request.entity_namespace or nil
    local base, problem = load(file, name, pose, namespace)
    if codeOrTemporary then os.remove(codeOrTemporary) end
    if not base then return failed(PARSE_ERROR, problem) end
    spawned[#spawned + 1] = base
    return results.ok {entity_name = entities.name(base)}
end

function M.spawnAll(request)
    local responses, count = {}, 0
    for i, one in ipairs(request.spawn_requests) do
        responses[i] = M.spawn(one)
        if responses[i].result.result ~= 1 then count = count + 1 end
    end
    local response = {result = results.OK, results = responses}
    if count > 0 then
        response.result = {result = SPAWN_FAILED, error_message = ('%d of %d entities were not spawned'):format(count, #responses)}
    end
    return response
end

--- Removes what was spawned.
function M.removeAll()
    for _, base in ipairs(spawned) do
        if sim.isHandle(base) then entities.remove(base) end
    end
    spawned = {}
end

---------------------------------------------------------------- what can be spawned

--- The files of folders that `isWanted`, by name; nil and the folder that cannot be read.
function M.filesIn(folders, isWanted)
    local found = {}
    for _, folder in ipairs(folders) do
        local path = M.fileOf(folder)
        if lfs.attributes(path, 'mode') ~= 'directory' then return nil, folder end
        for name in lfs.dir(path) do
            if isWanted(name) then found[#found + 1] = path:gsub('/$', '') .. '/' .. name end
        end
    end
    table.sort(found)
    return found
end

--- The folder of the scene, if it has one.
function M.sceneFolder()
    local path = sim.getStringParam(sim.stringparam_scene_path)
    if path == '' then return {} end
    return {path}
end

local function isSpawnable(name) return name:find('%.urdf$') or name:find('%.sdf$') or name:find('%.ttm$') end

function M.list(request)
    local folders = M.sceneFolder()
    table.move(request.sources, 1, #request.sources, #folders + 1, folders)
    local files, unknown = M.filesIn(folders, isSpawnable)
    if not files then return results.failed(results.OPERATION_FAILED, ("the source '%s' is no folder"):format(unknown)) end
    local spawnables = {}
    for i, file in ipairs(files) do
        spawnables[i] = {entity_resource = {uri = 'file://' .. file}, description = file:match('[^/]+$')}
    end
    return results.ok {spawnables = spawnables}
end

return M
