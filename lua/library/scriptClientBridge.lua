--[[
What programs call that hold the simulator in their own process, as CoppeliaSim's Python package does: modules, descriptions, calls with values as CBOR.
]]
local sim = require 'sim'
local cbor = require 'simCBOR'
local namespaces = require 'remote.namespaces'

scriptClientBridge = {}

--- Makes a module a global, by its name without a version.
function scriptClientBridge.require(name) _G[name:match('^[^-]*')] = require(name) end

local function field(name)
    local value = _G
    for word in name:gmatch('[^.]+') do
        if type(value) ~= 'table' then return nil end
        value = value[word]
    end
    return value
end

--- The value that a dotted name leads to.
function scriptClientBridge.getField(name) return field(name) end

local function member_names()
    local names = sim.getApiFunc(-1, 'sim.')
    for place, name in ipairs(names) do names[place] = name:sub(#'sim.' + 1) end
    return names
end

--- What an object, or what a dotted name leads to, consists of: {func} and {const}, and the same of the tables in it.
function scriptClientBridge.info(object)
    if type(object) == 'string' then object = field(object) end
    return namespaces.describe(object, member_names)
end

--- A call as CBOR, {func, args}; its answer as CBOR, {success, result} or {success, error}.
function scriptClientBridge.call(request)
    local call = cbor.decode(tostring(request))
    local results = table.pack(pcall(function() return field(call.func)(table.unpack(call.args or {})) end))
    if not results[1] then return cbor.encode {success = false, error = tostring(results[2])} end
    return cbor.encode {success = true, result = {table.unpack(results, 2, results.n)}}
end

return scriptClientBridge
