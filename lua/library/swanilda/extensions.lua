--[[
What scripts have from the start and seldom use, each too small for a file of its own: the extensions of the standard libraries, tables
that find their content elsewhere. Loaded when the first of them is used.
]]

local M = {}

-- The extensions are copied in when the first missing name is asked for.
local function extend(library, module, key)
    setmetatable(library, nil)
    for name, f in pairs(_quietRequire(module .. '.functions')) do
        if library[name] == nil then library[name] = f end
    end
    return library[key]
end

function M.string(library, key) return extend(library, 'stringx', key) end
function M.table(library, key) return extend(library, 'tablex', key) end
function M.math(library, key) return extend(library, 'mathx', key) end

function M.operator(_, key) return _quietRequire('functional.functions').operator[key] end

--- Where the original keeps the functions of its interface. Native plugins are in another table.
function M.interface(_, key) return key == 'sim' and _quietRequire('sim') or nil end

--- Its plugin made it a global of all scripts, which never required it.
function M.remoteApi(proxy, key)
    local module = _quietRequire('simRemoteApi')
    if rawget(_G, 'simRemoteApi') == proxy then simRemoteApi = module end
    return module[key]
end

function M.wrap(original, generator) return generator(original) end

--- For what is neither string nor buffer.
function M.tobuffer(value) return tobuffer(tostring(value)) end

--- Lua 5.3 took any number as a seed.
function M.randomseed(x, ...)
    if type(x) == 'number' and not math.tointeger(x) then x = x == x and math.abs(x) < 2^62 and math.floor(x) or 0 end
    if x == nil then return _randomseed() end
    return _randomseed(x, ...)
end

return M
