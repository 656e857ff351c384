--[[
Custom data and signals in their table and buffer forms, over the native string form.

Does not store anything itself.
]]

local sim = ...
local M = {}

local INFO_TAG <const> = '__info__' -- companion data: how each tag of the object is encoded
local CBOR <const> = 1 -- packing scheme of sim.packTable

--- Reads custom data as a buffer.
-- @api buffer data = sim.readCustomBufferData(int handle, string tag)
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @return data nil if there is none
function M.readCustomBufferData(handle, tag)
    local data = sim.readCustomStringData(handle, tag)
    return data and tobuffer(data)
end

--- Writes custom data.
-- @api sim.writeCustomBufferData(int handle, string tag, buffer data)
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @param data empty or nil: removes the tag
function M.writeCustomBufferData(handle, tag, data) sim.writeCustomStringData(handle, tag, data or '') end

--- Reads custom data as a string; older name of sim.readCustomStringData.
-- @api string data = sim.readCustomDataBlock(int handle, string tag)
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @return data nil if there is none
function M.readCustomDataBlock(handle, tag)
    local data = sim.readCustomStringData(handle, tag)
    return data and #data > 0 and data or nil
end

--- Writes custom data; older name of sim.writeCustomStringData.
-- @api sim.writeCustomDataBlock(int handle, string tag, string data)
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @param data empty or nil: removes the tag
function M.writeCustomDataBlock(handle, tag, data) sim.writeCustomStringData(handle, tag, data or '') end

--- Names of the custom data of an object.
-- @api string[] tags = sim.readCustomDataBlockTags(int handle)
-- @param handle object, sim.handle_scene or sim.handle_app
-- @return tags nil if there are none
function M.readCustomDataBlockTags(handle)
    local tags = sim.readCustomDataTags(handle)
    return tags and #tags > 0 and tags or nil
end

local function unpackInfo(packed)
    local info = packed and #packed > 0 and sim.unpackTable(packed) or {}
    info.blocks = info.blocks or {}
    return info
end

-- What the last change of a tag made of the companion data: programs write the same few tags again and again.
local changed, changedCount = {}, 0 -- tag -> {dataType, before, after}
local MAX_CHANGED <const> = 16

local function noteChange(tag, dataType, before, after)
    if not changed[tag] then
        if changedCount == MAX_CHANGED then changed, changedCount = {}, 0 end
        changedCount = changedCount + 1
    end
    changed[tag] = {dataType, before, after}
end

local function writeDataType(handle, tag, dataType)
    if tag == INFO_TAG then return end
    local packed = sim.readCustomStringData(handle, INFO_TAG)
    local known = changed[tag]
    if known and known[1] == dataType and known[2] == packed then
        sim.writeCustomStringData(handle, INFO_TAG, known[3])
        return
    end
    local info = unpackInfo(packed)
    if dataType == nil and info.blocks[tag] == nil then return end
    info.blocks[tag] = dataType and {type = dataType} or nil
    local after = sim.packTable(info)
    noteChange(tag, dataType, packed, after)
    sim.writeCustomStringData(handle, INFO_TAG, after)
end

--- Reads custom data and the kind it was written as.
-- @api string data, string dataType = sim.readCustomDataBlockEx(int handle, string tag, map options = {})
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @return data nil if there is none
-- @return dataType for instance table or cbor; nil if unknown
function M.readCustomDataBlockEx(handle, tag)
    local data = sim.readCustomStringData(handle, tag)
    if not data or #data == 0 then return nil end
    local block = tag ~= INFO_TAG and unpackInfo(sim.readCustomStringData(handle, INFO_TAG)).blocks[tag]
    return data, block and block.type or nil
end

--- Writes custom data and the kind it is.
-- @api sim.writeCustomDataBlockEx(int handle, string tag, string data, map options = {})
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @param data empty: removes the tag
-- @param options dataType: the kind
function M.writeCustomDataBlockEx(handle, tag, data, options)
    sim.writeCustomStringData(handle, tag, data or '')
    local empty = data == nil or #data == 0
    writeDataType(handle, tag, not empty and options and options.dataType or nil)
end

local WRITE_ARGS = {{type = 'int'}, {type = 'string'}, {type = 'table'}, {type = 'table', default = {}}}
local READ_ARGS = {{type = 'int'}, {type = 'string'}, {type = 'table', default = {}}}
local integer <const>, type <const> = math.type, type

-- Whether arguments need no check and no defaults.
local function areComplete(count, handle, tag, data)
    return count == 3 and integer(handle) == 'integer' and type(tag) == 'string' and type(data) == 'table'
end

--- Writes a table as custom data.
-- @api sim.writeCustomTableData(int handle, string tag, map data, map options = {})
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @param data empty: removes the tag
-- @param options dataType: table (default) or cbor
function M.writeCustomTableData(...)
    local handle, tag, data, options = ...
    if areComplete(select('#', ...), handle, tag, data) then
        options = WRITE_ARGS[4].default
    else
        handle, tag, data, options = require('checkargs.check')(WRITE_ARGS, ...)
    end
    if next(data) == nil then return M.writeCustomDataBlockEx(handle, tag, '') end
    local dataType = options.dataType or 'table'
    local packed = dataType == 'cbor' and sim.packTable(data, CBOR) or sim.packTable(data)
    M.writeCustomDataBlockEx(handle, tag, packed, {dataType = dataType})
end

--- Reads a table from custom data.
-- @api map data = sim.readCustomTableData(int handle, string tag, map options = {})
-- @param handle object, sim.handle_scene or sim.handle_app
-- @param tag its name
-- @return data empty if there is none
function M.readCustomTableData(...)
    local handle, tag = ...
    if select('#', ...) ~= 2 or integer(handle) ~= 'integer' or type(tag) ~= 'string' then
        handle, tag = require('checkargs.check')(READ_ARGS, ...)
    end
    local data = sim.readCustomStringData(handle, tag)
    if not data or #data == 0 then return {} end
    return sim.unpackTable(data) -- tells both encodings apart by their first byte
end

--- Sets a buffer signal.
-- @api int result = sim.setBufferSignal(string name, buffer value)
-- @param name of the signal
-- @param value bytes
-- @return result 1
function M.setBufferSignal(name, value) return sim.setStringSignal(name, value) end

--- Value of a buffer signal.
-- @api buffer value = sim.getBufferSignal(string name)
-- @param name of the signal
-- @return value nothing if the signal does not exist
function M.getBufferSignal(name)
    local value = sim.getStringSignal(name)
    if value then return tobuffer(value) end
end

--- Removes a buffer signal.
-- @api int result = sim.clearBufferSignal(string name)
-- @param name of the signal
-- @return result 1 if it existed, else 0
function M.clearBufferSignal(name) return sim.clearStringSignal(name) end

local function persistentTags() return sim.getPersistentDataTags() or {} end

--- Names of persistent data that match a pattern.
-- @api string[] tags = sim.getMatchingPersistentDataTags(string pattern)
-- @param pattern of Lua
-- @return tags in the order of sim.getPersistentDataTags
function M.getMatchingPersistentDataTags(...)
    local pattern = require('checkargs.check')({{type = 'string'}}, ...)
    local matching = {}
    for _, tag in ipairs(persistentTags()) do
        if tag:match(pattern) then matching[#matching + 1] = tag end
    end
    return matching
end

return M
