--[[
Windows belong to the script that creates them and end with it. Nothing is drawn: widgets keep their values, so that scripts run with nobody watching, and
tests use them (`t.ui`). The functions a window names (`on-click="name"`) are globals of its script; they are called at the end of a loop iteration, never inside
of a call of simUI.

A handle is a text. Widgets without an id get negative ones. Positions and sizes are those of a screen of 1280 by 800 pixels.
]]

local _, simUI = ...

local open = simUI.create

---------------------------------------------------------------- names in the text of a window

-- Above a function that `create` calls: itself, `create`, and the function that has called it.
local CALLER <const> = 3

-- The local variables of the function that has called `create`: of several with a name, the first. A value is in a table, as it may be nil.
local function localsOfCaller()
    local found, i = {}, 1
    if not debug.getinfo(CALLER, 'l') then return found end
    while true do
        local name, value = debug.getlocal(CALLER, i)
        if not name then return found end
        found[name] = found[name] or {value}
        i = i + 1
    end
end

local function newId(name)
    simUI.__id = (simUI.__id or 0) + 1
    _G[name] = simUI.__id
    return simUI.__id
end

--- Opens a window. `${name}` in its text is replaced by the local variable of that name, else by the global one, else by a new number, which becomes a
--- global variable.
-- @api string uiHandle = simUI.create(string xml)
-- @param xml the window: see docs/spec/simui.md
-- @return uiHandle a text
function simUI.create(xml)
    local names = {}
    if xml == nil then return open() end
    if type(xml) == 'string' then
        local locals = localsOfCaller()
        xml = xml:gsub('%${(.-)}', function(name)
            local value = locals[name] and locals[name][1]
            if not locals[name] then
                value = rawget(_G, name)
                value = value == nil and newId(name) or tostring(value)
            end
            names[name] = math.tointeger(tonumber(value))
            return value
        end)
    end
    return open(xml, names)
end

---------------------------------------------------------------- what is built on other functions

--- Sets a parameter of a node of a scene, by the type of its value.
-- @api simUI.setScene3DNodeParam(string ui, int widget, int nodeId, string paramName, any paramValue)
-- @param ui the window
-- @param widget the scene3d widget
-- @param nodeId the node
-- @param paramName its name
-- @param paramValue a number, a text, or two to four numbers
function simUI.setScene3DNodeParam(ui, widget, nodeId, paramName, paramValue)
    if math.type(paramValue) == 'integer' then
        return simUI.setScene3DNodeIntParam(ui, widget, nodeId, paramName, paramValue)
    elseif type(paramValue) == 'number' then
        return simUI.setScene3DNodeFloatParam(ui, widget, nodeId, paramName, paramValue)
    elseif type(paramValue) == 'string' then
        return simUI.setScene3DNodeStringParam(ui, widget, nodeId, paramName, paramValue)
    end
    local set = type(paramValue) == 'table' and simUI['setScene3DNodeVector' .. #paramValue .. 'Param']
    if not set then error('in simUI.setScene3DNodeParam: unsupported type of value', 2) end
    return set(ui, widget, nodeId, paramName, table.unpack(paramValue))
end

--- What a banner without a callback of its own does: it goes away.
-- @api simUI.bannerDefaultButtonCallback(int id, string key)
-- @param id the banner
-- @param key of the button
function simUI.bannerDefaultButtonCallback(id, key) simUI.bannerDestroy(id) end

return simUI
