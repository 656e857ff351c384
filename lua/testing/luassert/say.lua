--[[
Texts by key and language: the module `say`, at a place where no script's file of that name hides it from luassert.
]]

local DEFAULT = 'en'

local texts = {[DEFAULT] = {}}
local namespace, fallback = DEFAULT, DEFAULT

local say = {}

local function language(name)
    texts[name] = texts[name] or {}
    return name
end

function say:set_namespace(name) namespace = language(name) end
function say:set_fallback(name) fallback = language(name) end
function say:set(key, text) texts[namespace][key] = text end

-- The text of a key with its values, or nil.
local function lookUp(_, key, values)
    if key == nil then return nil end
    local text = texts[namespace][key]
    if text == nil then text = texts[fallback][key] end
    if values == nil or type(text) ~= 'string' then return text end
    if type(values) ~= 'table' then
        error(("expected parameter table to be a table, got '%s'"):format(type(values)), 2)
    end
    local count = values.n or #values
    if count == 0 then return text end
    local isWhole, result = pcall(string.format, text, table.unpack(values, 1, count))
    return isWhole and result or error(result, 2)
end

return setmetatable(say, {__call = lookUp})
