--[[
Windows of scripts in tests: `t.ui('Title')`. What a test does with a widget is checked as what a person does: a disabled or hidden one takes no
inputs. Names of widgets are those that `t.ui` in swanilda/test.lua lists.
]]

local M = {}

local Window = {}
Window.__index = Window

--- The words of a native error, without line and function.
function M.reason(message) return (tostring(message):gsub('^%-?%d+: ', ''):gsub('^in swanilda%.test%.%w+: ', '')) end

local function try(level, fn, ...)
    local results = table.pack(pcall(fn, ...))
    if not results[1] then error(M.reason(results[2]), level + 1) end
    return table.unpack(results, 2, results.n)
end

function M.find(native, title, check)
    local handle = try(3, native.window, title)
    return setmetatable({ handle = handle, native = native, check = check }, Window)
end

--- The number by which simUI knows a widget.
function Window:id(widget) return try(4, self.native.widget, self.handle, tostring(widget)) end

function Window:_do(widget, action, ...)
    try(3, self.native.windowInput, self.handle, self:id(widget), action, ...)
    self.check()
    return self
end

function Window:_state(widget) return try(3, self.native.widgetState, self.handle, self:id(widget)) end

function Window:click(widget) return self:_do(widget, 'click') end

function Window:set(widget, value) return self:_do(widget, 'value', value) end

function Window:enter(widget, text)
    self:_do(widget, 'value', text)
    return self:_do(widget, 'finish')
end

function Window:select(widget, ...) return self:_do(widget, 'select', ...) end

function Window:cell(widget, row, column, text) return self:_do(widget, 'cell', row, column, text) end

function Window:link(widget, href) return self:_do(widget, 'link', href) end

function Window:key(widget, key, text) return self:_do(widget, 'key', key, text) end

function Window:value(widget) return self:_state(widget).value end

function Window:is_enabled(widget) return self:_state(widget).enabled end

function Window:is_visible(widget) return self:_state(widget).visible end

function Window:close()
    try(2, self.native.closeWindow, self.handle)
    self.check()
end

function Window:title() return require('simUI').getTitle(self.handle) end

--- Whether it is still there, and shown.
function Window:is_open()
    local exists, isVisible = pcall(require('simUI').isVisible, self.handle)
    return exists and isVisible
end

return M
