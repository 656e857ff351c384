--[[
Names from before aliases: a name without a number takes the one of the script's object, which the global sim_script_name_index holds.

Does not look names up: that is native (sim._getObjectHandle).
]]

local sim = ...
local M = {}

local NO_ERROR <const> = 1 -- option of the global simGetObjectHandle

--- Handle of the object at a path or with an old-style name.
-- @api int objectHandle = sim.getObjectHandle(string path, map options = {})
-- @param path as in sim.getObject, or an old name such as robot#0; sim.handle_self: the object of this script
-- @param options noError: -1 instead of an error
-- @return objectHandle the object
function M.getObjectHandle(path, options)
    local handle = sim._getObjectHandle(path, options, sim_script_name_index)
    if type(path) ~= 'string' or not path:find('^[/.:]') then
        addLog(
            sim.verbosity_scriptwarnings | sim.verbosity_once,
            'sim.getObjectHandle is deprecated. Use sim.getObject instead.'
        )
    end
    return handle
end

--- Handle of the object at a path or with an old-style name; the global simGetObjectHandle.
-- @api int objectHandle = sim._simGetObjectHandle(string path, int index = -1, int proxy = -1, int options = 0)
-- @param path as in sim.getObject, or an old name
-- @param index which of several objects at a path; -1: the first
-- @param proxy object to start from; -1: that of the script
-- @param options bit 0: -1 instead of an error
-- @return objectHandle the object
function M._simGetObjectHandle(path, index, proxy, options)
    local lookup = {index = index, proxy = proxy, noError = (options or 0) & NO_ERROR ~= 0}
    local handle = sim._getObjectHandle(path, lookup, sim_script_name_index)
    return handle
end

--- Handle of an object by name, -1 if there is none.
-- @api int objectHandle = sim.getObjectHandle_noErrorNoSuffixAdjustment(string name)
-- @param name path or old-style name
-- @return objectHandle or -1
function M.getObjectHandle_noErrorNoSuffixAdjustment(name)
    local handle = sim._getObjectHandle(name, {noError = true})
    return handle
end

--- Splits an old-style name at its `#`; without one the suffix is -1.
-- @api int suffixNumber, string nameWithoutSuffix = sim.getNameSuffix(string name = nil)
-- @param name the name; nil for the suffix of the calling script
-- @return suffixNumber -1 if there is none
-- @return nameWithoutSuffix the name before the `#`; not returned without a name
function M.getNameSuffix(name)
    if name == nil then return sim_script_name_index end
    local stem, number = name:match('^(.*)#(%d*)$')
    if not stem then return -1, name end
    return number == '' and -1 or math.tointeger(tonumber(number)), stem
end

--- Chooses the number that old names without one take in this script.
-- @api int result = sim.setNameSuffix(int suffixNumber)
-- @param suffixNumber -1: names are taken as they are
-- @return result 1
function M.setNameSuffix(suffixNumber)
    sim_script_name_index = suffixNumber
    return 1
end

return M
