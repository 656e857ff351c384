--[[
Worlds of the standard simulation interfaces of ROS 2: scenes, and worlds of SDF. Internal.
]]

local sim = require('sim')
local results = require('remote.ros2.results')
local entities = require('remote.ros2.entities')
local spawning = require('remote.ros2.spawning')

local M = {}

local UNSUPPORTED_FORMAT <const>, NO_RESOURCE <const>, PARSE_ERROR <const> = 101, 102, 103
local NO_WORLD_LOADED <const>, DEFAULT_SOURCES_FAILED <const> = 101, 101

local isUnloaded = false
local loaded -- { name, uri } of the world that a client has loaded

local function nameOf(file) return file:match('([^/]+)%.[%w.]-$') or file end

--- The world there is: its name and URI; nil without one.
function M.current()
    if isUnloaded then return nil end
    if loaded then return loaded end
    local file = sim.getStringParam(sim.stringparam_scene_path_and_name)
    return {name = file ~= '' and nameOf(file) or 'default', uri = file ~= '' and 'file://' .. file or ''}
end

local function message(world) return {name = world.name, world_resource = {uri = world.uri}, description = '', tags = {}} end

function M.get()
    local world = M.current()
    if not world then return results.failed(NO_WORLD_LOADED, 'no world is loaded') end
    return results.ok {world = message(world)}
end

---------------------------------------------------------------- loading

local function isScene(file)
    return file:find('%.ttt$') or file:find('%.simscene%.xml$') or file:find('%.lua$')
end

local function isWorldOfSdf(file) return file:find('%.sdf$') or file:find('%.world$') end

local function empty()
    sim.closeScene()
    local objects = {}
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        if sim.getObjectType(object) == sim.sceneobject_shape then objects[#objects + 1] = object end
    end
    if #objects > 0 then sim.removeObjects(objects) end
end

-- Entities have the names of the models of the file, where each model has become one object without a parent.
local function name(file)
    local names, roots = {}, {}
    local description <close> = assert(io.open(file))
    for found in description:read('a'):gmatch('<model%s+name%s*=%s*["\'](.-)["\']') do names[#names + 1] = found end
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        if sim.getObjectParent(object) == -1 and entities.isEntity(object) then roots[#roots + 1] = object end
    end
    if #names ~= #roots then return end
    for i, object in ipairs(roots) do sim.setObjectAlias(object, names[i]) end
end

local function loadFile(file)
    if isScene(file) then return sim.loadScene(file) end
    empty()
    require('simSDF').import(file)
    name(file)
end

-- The file of a world, and the file to remove afterwards; nil with a code and the reason.
local function located(resource)
    if resource.resource_string ~= '' then
        if not resource.resource_string:find('<sdf') then return nil, UNSUPPORTED_FORMAT, 'the text is no world of SDF' end
        local file = spawning.temporary(resource.resource_string, 'sdf')
        return file, file
    end
    if resource.uri == '' then return nil, NO_RESOURCE, 'a URI or a text is needed' end
    local file = spawning.fileOf(resource.uri)
    if isScene(file) or isWorldOfSdf(file) then return file end
    return nil, UNSUPPORTED_FORMAT, ("'%s' is no file .ttt, .simscene.xml, .lua, .sdf or .world"):format(resource.uri)
end

--- A world is loaded: the add-on sets what is to be done then.
function M.hasLoaded() end

function M.load(request)
    local resource = request.world_resource
    local file, codeOrTemporary, why = located(resource)
    if not file then return results.failed(codeOrTemporary, why) end
    local ok, problem = pcall(loadFile, file)
    if codeOrTemporary then os.remove(codeOrTemporary) end
    if not ok then return results.failed(PARSE_ERROR, results.reason(problem)) end
    isUnloaded = false
    M.hasLoaded()
    loaded = {name = resource.uri ~= '' and nameOf(file) or 'world', uri = resource.uri}
    return results.ok {world = message(loaded)}
end

function M.unload()
    if not M.current() then return results.failed(NO_WORLD_LOADED, 'no world is loaded') end
    empty()
    isUnloaded, loaded = true, nil
    return results.ok()
end

---------------------------------------------------------------- what can be loaded

local function isListed(name) return isScene(name) and not name:find('%.lua$') or name:find('%.world$') end

function M.list(request)
    if #request.filter.tags > 0 then return results.ok {worlds = {}} end -- files have no tags
    local files = spawning.filesIn(spawning.sceneFolder(), isListed)
    if not files then return results.failed(DEFAULT_SOURCES_FAILED, 'the folder of the scene cannot be read') end
    local more, unknown = spawning.filesIn(request.additional_sources, isListed)
    if not more and not request.continue_on_error then
        return results.failed(results.OPERATION_FAILED, ("the source '%s' is no folder"):format(unknown))
    end
    local worlds = {}
    for _, list in ipairs {files, more or {}} do
        for _, file in ipairs(list) do worlds[#worlds + 1] = message {name = nameOf(file), uri = 'file://' .. file} end
    end
    return results.ok {worlds = worlds}
end

return M
