--[[
Shared by configUi.lua: the schema of settings. Each element has a type, a default and a control of the window; what a schema leaves out is filled in.
]]

local M = {}

local DEFAULTS <const> = {string = '', int = 0, float = 0, color = {0.85, 0.85, 1}, bool = false, callback = ''}
local CONTROLS <const> = {string = 'edit', bool = 'checkbox', color = 'color', choices = 'radio', callback = 'button'}
local KNOWN <const> = {edit = true, slider = true, spinbox = true, checkbox = true, color = true, radio = true, combo = true, button = true}

local function typeOf(element)
    return element.type or element.choices and 'choices' or element.callback and 'callback' or error 'missing type'
end

local function controlOf(element)
    if element.type == 'int' or element.type == 'float' then
        local isLimited = element.minimum and element.maximum
        return element.type == 'float' and isLimited and 'slider' or 'spinbox'
    end
    return CONTROLS[element.type] or error(('unknown type: "%s"'):format(element.type))
end

local function completeElement(name, element)
    element.key = element.key or name
    element.name = element.name or name
    element.type = typeOf(element)
    if element.default == nil then
        element.default = DEFAULTS[element.type]
        if element.default == nil then error(('missing "default" for key "%s"'):format(element.key)) end
    end
    element.ui = element.ui or {}
    local ui = element.ui
    ui.control = ui.control or controlOf(element)
    if not KNOWN[ui.control] then error(('unknown ui control: "%s"'):format(ui.control)) end
    ui.order, ui.tab, ui.group, ui.col = ui.order or 0, ui.tab or '', ui.group or 1, ui.col or 1
    if not ui.fromUiValue ~= not ui.toUiValue then error '"fromUiValue" and "toUiValue" must be both set' end
end

--- Fills in what the elements of a schema leave out.
function M.complete(schema)
    for name, element in pairs(schema) do
        local ok, reason = pcall(completeElement, name, element)
        if not ok then error(('element "%s": %s'):format(name, reason), 0) end
    end
end

--- Names of the elements in the order of the window.
function M.ordered(schema)
    local names = {}
    for name in pairs(schema) do names[#names + 1] = name end
    table.sort(names, function(a, b)
        local first, second = schema[a].ui.order, schema[b].ui.order
        if first ~= second then return first < second end
        return a < b
    end)
    return names
end

--- The choices of an element: a table of texts by value.
function M.choices(owner, element)
    local choices = element.choices
    return type(choices) == 'function' and choices(owner, element) or choices
end

return M
