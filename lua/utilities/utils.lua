--[[
Helpers of old scripts, and a few for interactive use; one file for both generations of this module.

    createCustomUi(xml, title, position, closeable, onClose, modal, resizable, activate, attributes, size)   opens a window
    getSelectedEditWidget(ui), setSelectedEditWidget(ui, id)
    getRadiobuttonValFromBool(on), getCheckboxValFromBool(on)                          values of widgets
    writeSessionPersistentObjectData(object, tag, ...), readSessionPersistentObjectData(object, tag)
    fastIdleLoop(on), isPluginLoaded(name)
    hexdump(data), printbytes(data), rerequire(name), apropos(input, pos)              as the global functions
    cbordump(data), luac(code), coverage(options), unittest(name)

It defines the globals that old scripts count on: `include`, `getObjectsWithTag`, `getObjectHandle_noError`, `getObjectHandle_noErrorNoSuffixAdjustment`, `stringToArray`,
`executeCode`, `createOpenBox`, `customUi_populateCombobox`, `canScaleModelNonIsometrically`, `scaleModelNonIsometrically`, `asserttype` and its kin, and functions of
`table`, `string` and `math`.
]]

local sim = _quietRequire 'sim'
local globals = require 'swanilda.old_helpers'
local utils = {}

for name, f in pairs(globals) do _G[name] = f end

---------------------------------------------------------------- windows

local function attribute(name, value) return value ~= nil and (' %s="%s"'):format(name, tostring(value)) or '' end

--- Opens a window of which only the content is given.
function utils.createCustomUi(xml, title, position, closeable, onClose, modal, resizable, activate, attributes, size)
    local placement = 'placement="center"'
    if type(position) == 'table' then
        placement = ('placement="absolute" position="%d,%d"'):format(math.floor(position[1]), math.floor(position[2]))
    elseif position == 'bottomRight' or position == 'bottomLeft' or position == 'topLeft' or position == 'topRight' then
        local x = position:find('Right') and -50 or 50
        local y = position:find('bottom') and -50 or 50
        placement = ('placement="relative" position="%d,%d"'):format(x, y)
    end
    local text = '<ui' .. attribute('title', title) .. attribute('closeable', closeable or false)
        .. (closeable and attribute('on-close', onClose) or '') .. attribute('modal', modal or false)
        .. attribute('resizable', resizable or false) .. attribute('activate', activate ~= false)
        .. (size and attribute('size', size[1] .. ',' .. size[2]) or '') .. ' ' .. placement .. ' ' .. (attributes or '')
    return _quietRequire('simUI').create(text .. '>' .. xml .. '</ui>')
end

function utils.getSelectedEditWidget(ui) return _quietRequire('simUI').getCurrentEditWidget(ui) end

function utils.setSelectedEditWidget(ui, id)
    if id and id >= 0 then _quietRequire('simUI').setCurrentEditWidget(ui, id) end
end

function utils.getRadiobuttonValFromBool(on) return on and 1 or 0 end

function utils.getCheckboxValFromBool(on) return on and 2 or 0 end

---------------------------------------------------------------- data and plugins

local function sessionTag(object, tag) return '@tmp/' .. object .. '.' .. tag end

--- Keeps values until the program ends.
function utils.writeSessionPersistentObjectData(object, tag, ...)
    sim.writeCustomStringData(sim.handle_app, sessionTag(sim.getObjectUid(object), tag), sim.packTable{...})
end

--- What was kept, as several results.
function utils.readSessionPersistentObjectData(object, tag)
    local packed = sim.readCustomStringData(sim.handle_app, sessionTag(sim.getObjectUid(object), tag))
    if packed and #packed > 0 then return table.unpack(sim.unpackTable(packed)) end
end

--- Makes the idle loop fast, or slow again. Nothing to do: it does not wait here.
function utils.fastIdleLoop() end

--- Whether a plugin is there.
function utils.isPluginLoaded(name)
    local module = name:sub(1, 3) == 'sim' and name or 'sim' .. name
    return (pcall(_quietRequire, module))
end

---------------------------------------------------------------- tools

local tools = {
    apropos = function() return require('swanilda.console')._getCompletion end,
    hexdump = function() return require('swanilda.console').hexdump end,
    printbytes = function() return require('swanilda.console').printBytes end,
    rerequire = function() return require('swanilda.modload').rerequire end,
    cbordump = function()
        return function(data) print(getAsString(require('org.conman.cbor').decode(tostring(data)))) end
    end,
    luac = function() return function(code) return string.dump(assert(load(code))) end end,
}

local ELSEWHERE <const> = {coverage = 'swanilda test --coverage', unittest = 'swanilda test'}

return setmetatable(utils, {__index = function(_, name)
    if ELSEWHERE[name] then error(('utils.%s: use `%s`'):format(name, ELSEWHERE[name]), 2) end
    return tools[name] and tools[name]()
end})
