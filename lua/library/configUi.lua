--[[
Settings of a model with a window: `require 'configUi'`, then `ConfigUI(modelType, schema, generateCallback)` in a customization script.

The values are custom data of the model (`__config__`), so other scripts read and change them. The callback that makes the model anew from them runs at the
earliest in the next pass. The window opens with `sysCall_userConfig`; everything else works without it (spec: models 4).
]]

local sim = _quietRequire 'sim'
local schemas = require 'swanilda.config.schema'

ConfigUI = {handleMap = {}}
local Methods = {}

---------------------------------------------------------------- values

local function copy(value)
    if type(value) ~= 'table' then return value end
    local result = {}
    for key, part in pairs(value) do result[key] = copy(part) end
    return result
end

local function same(a, b)
    if type(a) ~= 'table' or type(b) ~= 'table' then return a == b end
    for key, part in pairs(a) do
        if not same(part, b[key]) then return false end
    end
    for key in pairs(b) do
        if a[key] == nil then return false end
    end
    return true
end

function Methods:getObject() return self.getObjectCallback and self:getObjectCallback() or sim.getObject '.' end

function Methods:getObjectName()
    if self.getObjectNameCallback then return self:getObjectNameCallback() end
    return sim.getObjectAlias(self:getObject(), 1)
end

function Methods:readBlock(name) return sim.readCustomTableData(self:getObject(), self.dataBlockName[name]) end

function Methods:writeBlock(name, data) sim.writeCustomTableData(self:getObject(), self.dataBlockName[name], data) end

--- The schema of the model's data, or that of the constructor, with everything filled in.
function Methods:readSchema()
    local schema = self:readBlock 'schema'
    if next(schema) then
        self.schema = schema
    elseif not self.schema then
        error('schema not provided, and not found in the custom data block ' .. self.dataBlockName.schema, 0)
    end
    schemas.complete(self.schema)
end

function Methods:readInfo()
    self.info = self:readBlock 'info'
    self.info.modelType = self.modelType
end

function Methods:writeInfo() self:writeBlock('info', self.info) end

function Methods:defaultConfig()
    local config = {}
    for name, element in pairs(self.schema) do config[name] = copy(element.default) end
    return config
end

--- Defaults, with the stored values of what the schema knows.
function Methods:readConfig()
    if not self.schema then error 'readSchema() must be called before readConfig()' end
    local config = self:defaultConfig()
    for name, value in pairs(self:readBlock 'config') do
        if self.schema[name] then config[name] = value end
    end
    self.config = config
end

function Methods:writeConfig() self:writeBlock('config', self.config) end

--- Lets the callback run in the next pass.
function Methods:generate()
    if self.generateCallback then self.generatePending = true end
end

---------------------------------------------------------------- each pass

function Methods:handleConfig()
    if self.generatePending then
        self.generatePending = false
        self.generateCallback(self.config)
    end
    if self.oldConfig ~= nil and not same(self.config, self.oldConfig) then
        self.oldConfig = copy(self.config)
        self:updateWindow()
        self:writeConfig()
        self:generate()
        return
    end
    self.oldConfig = copy(self.config)
    if not same(self:readBlock 'config', self.config) then
        self:readConfig()
        self:updateWindow()
        self:writeConfig()
        self:generate()
        -- As in the original: the next pass finds a change, and the callback runs once more.
        self.oldConfig = {}
    end
end

---------------------------------------------------------------- the window, loaded when it is opened

local function window() return require 'swanilda.config.window' end

function Methods:showUi()
    if not self.uiHandle then window().open(self) end
end

function Methods:closeUi(byUser)
    if not self.uiHandle then return end
    window().close(self)
    if byUser then self.uistate.open = false end
end

function Methods:updateWindow()
    if self.uiHandle then window().showValues(self) end
end

---------------------------------------------------------------- callbacks of the script

local STATE <const> = '@tmp/uistate'

local function init(self)
    self:readSchema()
    self:readInfo()
    self:writeInfo()
    self:readConfig()
    self:writeConfig()
    self:generate()
    local object = self:getObject()
    self.uistate = sim.readCustomTableData(object, STATE)
    sim.writeCustomTableData(object, STATE, {})
    if self.uistate.open then self:showUi() end
end

local function cleanup(self)
    if self.uiHandle then
        self:closeUi(false)
        self.uistate.open = true
    end
    sim.writeCustomTableData(self:getObject(), STATE, self.uistate)
end

local function userConfig(self)
    if sim.getSimulationState() == sim.simulation_stopped then self:showUi() end
end

local HOOKS <const> = {
    {'sysCall_init', init},
    {'sysCall_cleanup', cleanup},
    {'sysCall_userConfig', userConfig},
    {'sysCall_nonSimulation', function(self) self:handleConfig() end},
    {'sysCall_beforeSimulation', function(self) self:closeUi(false) end},
    {'sysCall_sensing', function(self) self:handleConfig() end},
    {'sysCall_afterSimulation', function(self) if self.uistate.open then self:showUi() end end},
}

local function new(_, modelType, schema, generateCallback)
    local self = setmetatable({
        dataBlockName = {config = '__config__', info = '__info__', schema = '__schema__'},
        modelType = modelType,
        schema = schema,
        generateCallback = generateCallback,
        generatePending = false,
        uistate = {},
    }, {__index = Methods})
    for _, hook in ipairs(HOOKS) do
        local name, perform = table.unpack(hook)
        registerScriptFuncHook(name, function() perform(self) end, false)
    end
    return self
end

setmetatable(ConfigUI, {__call = new, __index = Methods})

function ConfigUI_changed(ui) window().changed(ConfigUI.handleMap[ui]) end

function ConfigUI_event(ui, id) window().event(ConfigUI.handleMap[ui], id) end

function ConfigUI_close(ui) ConfigUI.handleMap[ui]:closeUi(true) end

return true
