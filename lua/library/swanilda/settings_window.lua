--[[
Shared by the scripts of paths and graphs: a window of settings that are read and written as a person changes them.

A field is a table of `kind` (check, number, choice, text), `text` (its label), `read`, a function, and `write`, one that takes the new value; numbers have `minimum`,
`maximum` and `step`, choices `items`.
]]

local simUI = _quietRequire 'simUI'
local escaped = require('swanilda.config.controls').escaped
local M = {}

local kinds = {}

kinds.check = {
    create = function(field, id, handler)
        return ('<label text=""/><checkbox id="%d" text="%s" on-change="%s"/>'):format(id, escaped(field.text), handler)
    end,
    show = function(ui, id, value) simUI.setCheckboxValue(ui, id, value and 2 or 0) end,
    value = function(value) return value ~= 0 end,
}

kinds.number = {
    create = function(field, id, handler)
        local isFloat = field.step and field.step % 1 ~= 0
        return ('<label text="%s:"/><spinbox id="%d" minimum="%s" maximum="%s" step="%s" %s on-change="%s"/>'):format(
            escaped(field.text), id, field.minimum, field.maximum, field.step or 1, isFloat and 'decimals="3"' or '', handler)
    end,
    show = function(ui, id, value) simUI.setSpinboxValue(ui, id, value) end,
    value = function(value) return value end,
}

kinds.choice = {
    create = function(field, id, handler)
        local items = {}
        for i, item in ipairs(field.items) do items[i] = '<item>' .. escaped(item) .. '</item>' end
        return ('<label text="%s:"/><combobox id="%d" on-change="%s">%s</combobox>'):format(
            escaped(field.text), id, handler, table.concat(items))
    end,
    show = function(ui, id, value) simUI.setComboboxSelectedIndex(ui, id, value) end,
    value = function(value) return value end,
}

kinds.text = {
    create = function(field, id, handler)
        return ('<label text="%s:"/><edit id="%d" on-editing-finished="%s"/>'):format(escaped(field.text), id, handler)
    end,
    show = function(ui, id, value) simUI.setEditValue(ui, id, value) end,
    value = function(value) return value end,
}

local function showAll(ui, fields)
    for id, field in ipairs(fields) do kinds[field.kind].show(ui, id, field.read()) end
end

--- Opens a window. Its handlers are functions of `holder`, which scripts reach by the name `path`, as in `_S.graph`.
-- @param field name of the member of `holder` that keeps the handle of the window
-- @return handle
function M.open(holder, path, field, title, fields)
    local rows = {}
    for id, one in ipairs(fields) do rows[id] = kinds[one.kind].create(one, id, path .. '.' .. field .. '_changed') .. '<br/>' end
    local ui = simUI.create(('<ui title="%s" closeable="true" on-close="%s.%s_closed" layout="grid" placement="relative" position="-50,50">%s</ui>')
        :format(escaped(title), path, field, table.concat(rows)))
    holder[field] = ui
    holder[field .. '_changed'] = function(_, id, value)
        local one = fields[id]
        one.write(kinds[one.kind].value(value))
        showAll(ui, fields)
    end
    holder[field .. '_closed'] = function() M.close(holder, field) end
    showAll(ui, fields)
    return ui
end

--- Closes a window.
function M.close(holder, field)
    if not holder[field] then return end
    simUI.destroy(holder[field])
    holder[field] = nil
end

return M
