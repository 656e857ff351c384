--[[
Shared by configUi.lua: the window of settings. Tabs if there are several, groups in them, columns in groups; a label before each control.
]]

local simUI = _quietRequire 'simUI'
local controls = require 'swanilda.config.controls'
local schemas = require 'swanilda.config.schema'

local M = {}

-- The parts of names by what `part` says of each, in the order of their appearance.
local function split(names, schema, part)
    local parts, byKey = {}, {}
    for _, name in ipairs(names) do
        local key = schema[name].ui[part]
        if not byKey[key] then
            byKey[key] = {key = key}
            parts[#parts + 1] = byKey[key]
        end
        table.insert(byKey[key], name)
    end
    return parts
end

local function column(owner, names, newId)
    local lines = {}
    for _, name in ipairs(names) do
        local element = owner.schema[name]
        element.ui.id, element.ui.idLabel = newId(), newId()
        local isNamed = element.ui.control == 'checkbox' or element.ui.control == 'button'
        local label = isNamed and '' or controls.escaped(element.name) .. ':'
        lines[#lines + 1] = ('<label id="%d" text="%s"/>%s<br/>'):format(
            element.ui.idLabel, label, controls[element.ui.control].create(element, owner, newId))
    end
    return '<group flat="true" layout="grid">' .. table.concat(lines) .. '</group>'
end

local function groups(owner, names, newId)
    local texts = {}
    for _, group in ipairs(split(names, owner.schema, 'group')) do
        local columns = {}
        for i, part in ipairs(split(group, owner.schema, 'col')) do columns[i] = column(owner, part, newId) end
        texts[#texts + 1] = '<group layout="hbox">' .. table.concat(columns) .. '</group>'
    end
    return table.concat(texts)
end

local function content(owner, newId)
    local tabs = split(schemas.ordered(owner.schema), owner.schema, 'tab')
    if #tabs <= 1 then return tabs[1] and groups(owner, tabs[1], newId) or '' end
    owner.tabsId = newId()
    local pages = {}
    for i, tab in ipairs(tabs) do
        pages[i] = ('<tab title="%s">%s</tab>'):format(controls.escaped(tab.key), groups(owner, tab, newId))
    end
    return ('<tabs id="%d">%s</tabs>'):format(owner.tabsId, table.concat(pages))
end

local function setEnabled(owner, element, isEnabled)
    local ids = type(element.ui.id) == 'table' and element.ui.id or {element.ui.id}
    for _, id in pairs(ids) do
        simUI.setEnabled(owner.uiHandle, id, isEnabled)
        if owner.hideDisabledWidgets then simUI.setWidgetVisibility(owner.uiHandle, id, isEnabled) end
    end
    if owner.hideDisabledWidgets then simUI.setWidgetVisibility(owner.uiHandle, element.ui.idLabel, isEnabled) end
end

local function showEnabled(owner)
    for _, element in pairs(owner.schema) do
        local enabled = element.ui.enabled
        if type(enabled) == 'function' then enabled = enabled(owner, owner.config) end
        if enabled ~= nil then setEnabled(owner, element, enabled) end
    end
end

--- Shows the present values.
function M.showValues(owner)
    for name, element in pairs(owner.schema) do
        controls[element.ui.control].show(owner.uiHandle, element, owner.config[name], owner)
    end
    showEnabled(owner)
end

function M.open(owner)
    owner:readConfig()
    local last = 0
    local function newId()
        last = last + 1
        return last
    end
    local placed = 'placement="relative" position="-30,100"'
    if owner.uistate.pos then
        placed = ('placement="absolute" position="%d,%d"'):format(table.unpack(owner.uistate.pos))
    end
    owner.tabsId = nil
    local title = controls.escaped(owner:getObjectName() .. ' config')
    local text = ('<ui title="%s" closeable="true" on-close="ConfigUI_close" %s>%s</ui>'):format(title, placed, content(owner, newId))
    owner.uiHandle = simUI.create(text)
    ConfigUI.handleMap[owner.uiHandle] = owner
    M.showValues(owner)
    if owner.tabsId and owner.uistate.currentTab then simUI.setCurrentTab(owner.uiHandle, owner.tabsId, owner.uistate.currentTab) end
end

--- Notes where the window was, and closes it.
function M.close(owner)
    local ui = owner.uiHandle
    owner.uistate.pos = {simUI.getPosition(ui)}
    owner.uistate.currentTab = owner.tabsId and simUI.getCurrentTab(ui, owner.tabsId)
    ConfigUI.handleMap[ui], owner.uiHandle = nil, nil
    simUI.destroy(ui)
end

--- Reads all controls.
function M.changed(owner)
    for name, element in pairs(owner.schema) do
        local value = controls[element.ui.control].read(owner.uiHandle, element, owner)
        if value ~= nil then owner.config[name] = value end
    end
    owner:writeConfig()
    owner:generate()
    -- What the callback gets is known: the next pass does not find a change.
    owner.oldConfig = nil
    showEnabled(owner)
end

local function packed(owner) return _quietRequire('sim').packTable(owner.config) end

--- A button was pushed.
function M.event(owner, id)
    for name, element in pairs(owner.schema) do
        local control = controls[element.ui.control]
        if element.ui.id == id and control.event then
            local before = packed(owner)
            control.event(owner, element, name)
            if owner.uiHandle and packed(owner) ~= before then
                owner:writeConfig()
                owner:generate()
                owner.oldConfig = nil
                M.showValues(owner)
            end
            return
        end
    end
end

return M
