--[[
Shared by configUi.lua: the controls of the window of settings. Each has `create` (its text in the window), `show` (a value in it) and `read` (its value, nil to
leave the value as it is).
]]

local simUI = _quietRequire 'simUI'
local schemas = require 'swanilda.config.schema'

local M = {}

--- The steps of a slider of floats.
local STEPS <const> = 1000

function M.escaped(text) return (tostring(text):gsub('[&<>"]', {['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;', ['"'] = '&quot;'})) end

local function attributes(list)
    local texts = {}
    for i = 1, #list, 2 do
        if list[i + 1] ~= nil then texts[#texts + 1] = (' %s="%s"'):format(list[i], M.escaped(list[i + 1])) end
    end
    return table.concat(texts)
end

local function toUi(element, value)
    if value ~= nil and element.ui.toUiValue then return element.ui.toUiValue(value) end
    return value
end

local function fromUi(element, value)
    if element.ui.fromUiValue then return element.ui.fromUiValue(value) end
    return value
end

local function limit(element, name)
    if element.ui[name] ~= nil then return element.ui[name] end
    return toUi(element, element[name])
end

local function number(element, value) return element.type == 'int' and math.floor(value) or value end

-- A slider of floats without limits of its own has steps between the limits of the value.
local function isScaled(element) return element.type == 'float' and not (element.ui.minimum and element.ui.maximum) end

local function unsupported(control, element) error(('unsupported type for %s: %s'):format(control, element.type)) end

M.edit = {
    create = function(element)
        if element.type ~= 'string' then unsupported('edit', element) end
        return ('<edit id="%d" on-change="ConfigUI_changed"/>'):format(element.ui.id)
    end,
    show = function(ui, element, value) simUI.setEditValue(ui, element.ui.id, tostring(toUi(element, value))) end,
    read = function(ui, element) return fromUi(element, simUI.getEditValue(ui, element.ui.id)) end,
}

M.spinbox = {
    create = function(element)
        if element.type ~= 'int' and element.type ~= 'float' then unsupported('spinbox', element) end
        local isFloat = element.type == 'float'
        return '<spinbox' .. attributes{
            'id', element.ui.id, 'minimum', limit(element, 'minimum') or -1e9, 'maximum', limit(element, 'maximum') or 1e9,
            'step', limit(element, 'step') or isFloat and 0.001 or 1, 'decimals', element.ui.decimals, 'float', tostring(isFloat),
            'on-change', 'ConfigUI_changed',
        } .. '/>'
    end,
    show = function(ui, element, value) simUI.setSpinboxValue(ui, element.ui.id, toUi(element, value)) end,
    read = function(ui, element) return number(element, fromUi(element, simUI.getSpinboxValue(ui, element.ui.id))) end,
}

M.slider = {
    create = function(element)
        if element.type ~= 'int' and element.type ~= 'float' then unsupported('slider', element) end
        local least, most = limit(element, 'minimum'), limit(element, 'maximum')
        if isScaled(element) then least, most = 0, STEPS end
        return '<hslider' .. attributes{
            'id', element.ui.id, 'minimum', math.floor(least or 0), 'maximum', math.floor(most or 100), 'on-change', 'ConfigUI_changed',
        } .. '/>'
    end,
    show = function(ui, element, value)
        value = toUi(element, value)
        if isScaled(element) then
            local least, most = limit(element, 'minimum') or 0, limit(element, 'maximum') or 1
            value = most > least and STEPS * (value - least) / (most - least) or 0
        end
        simUI.setSliderValue(ui, element.ui.id, math.floor(value + 0.5))
    end,
    read = function(ui, element)
        local value = simUI.getSliderValue(ui, element.ui.id)
        if isScaled(element) then
            local least, most = limit(element, 'minimum') or 0, limit(element, 'maximum') or 1
            value = least + (most - least) * value / STEPS
        end
        return number(element, fromUi(element, value))
    end,
}

M.checkbox = {
    create = function(element)
        if element.type ~= 'bool' then unsupported('checkbox', element) end
        return '<checkbox' .. attributes{'id', element.ui.id, 'text', element.name, 'on-change', 'ConfigUI_changed'} .. '/>'
    end,
    show = function(ui, element, value) simUI.setCheckboxValue(ui, element.ui.id, toUi(element, value) and 2 or 0) end,
    read = function(ui, element) return fromUi(element, simUI.getCheckboxValue(ui, element.ui.id) > 0) end,
}

-- The values of choices, in order, and their texts.
local function sorted(owner, element)
    local values, choices = {}, schemas.choices(owner, element)
    for value in pairs(choices) do values[#values + 1] = value end
    table.sort(values, function(a, b)
        if type(a) == type(b) and type(a) ~= 'table' then return a < b end
        return tostring(a) < tostring(b)
    end)
    return values, choices
end

local function placeOf(value, values)
    for place, known in ipairs(values) do
        if known == value then return place end
    end
    error(('invalid value: %s'):format(tostring(value)))
end

M.combo = {
    create = function(element, owner)
        local values, choices = sorted(owner, element)
        local items = {}
        for i, value in ipairs(values) do items[i] = '<item>' .. M.escaped(choices[value]) .. '</item>' end
        return ('<combobox id="%d" on-change="ConfigUI_changed">%s</combobox>'):format(element.ui.id, table.concat(items))
    end,
    show = function(ui, element, value, owner)
        simUI.setComboboxSelectedIndex(ui, element.ui.id, placeOf(value, (sorted(owner, element))) - 1)
    end,
    read = function(ui, element, owner) return sorted(owner, element)[simUI.getComboboxSelectedIndex(ui, element.ui.id) + 1] end,
}

M.radio = {
    create = function(element, owner, newId)
        local values, choices = sorted(owner, element)
        local buttons = {}
        element.ui.id = {}
        for i, value in ipairs(values) do
            element.ui.id[value] = newId()
            buttons[i] = '<radiobutton'
                .. attributes{'id', element.ui.id[value], 'text', choices[value], 'on-click', 'ConfigUI_changed'} .. '/>'
        end
        return '<group flat="true" content-margins="0,0,0,0">' .. table.concat(buttons) .. '</group>'
    end,
    show = function(ui, element, value, owner)
        placeOf(value, (sorted(owner, element)))
        simUI.setRadiobuttonValue(ui, element.ui.id[value], 1)
    end,
    read = function(ui, element)
        for value, id in pairs(element.ui.id) do
            if simUI.getRadiobuttonValue(ui, id) == 1 then return value end
        end
    end,
}

local function pushed(text)
    return function(element)
        return '<button' .. attributes{'id', element.ui.id, 'text', text or element.name, 'on-click', 'ConfigUI_event'} .. '/>'
    end
end

M.color = {
    create = pushed(' '),
    show = function(ui, element, value)
        local r, g, b = table.unpack(toUi(element, value))
        local function part(x) return math.floor(255 * x + 0.5) end
        simUI.setStyleSheet(ui, element.ui.id, ('background-color: rgb(%d,%d,%d)'):format(part(r), part(g), part(b)))
    end,
    read = function() end,
    event = function(owner, element, name)
        local color = simUI.colorDialog(toUi(element, owner.config[name]), element.name, false, true)
        if color then owner.config[name] = fromUi(element, color) end
        return color ~= nil
    end,
}

M.button = {
    create = pushed(),
    show = function() end,
    read = function() end,
    event = function(owner, element) element.callback(owner) end,
}

return M
