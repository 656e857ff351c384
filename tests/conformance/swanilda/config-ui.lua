-- topic: modules
-- as: customization
-- passes: 0
-- loops: 12
-- spec: models 4
-- note: settings of a model: defaults, stored values, what a schema may not be, when the callback runs
sim = require 'sim'
require 'configUi'

local function reason(schema)
    local object = {getObjectCallback = function() return sim.getObject '.' end}
    local config = setmetatable({schema = schema, dataBlockName = {schema = '__schema__'}}, getmetatable(ConfigUI))
    config.getObjectCallback = object.getObjectCallback
    local ok, message = pcall(config.readSchema, config)
    return ok and 'no error' or message:gsub('^(element "%w+": ).*%d+: ', '%1')
end

local count, pass = 0, 0
local function callback() count = count + 1 end

local function block() return sim.readCustomTableData(sim.getObject '.', '__config__') end

local settings = ConfigUI('T', {a = {type = 'int', maximum = 10}, b = {choices = {x = 'X', y = 'Y'}, default = 'y'}}, callback)

function sysCall_init()
    print(reason{a = {}})
    print(reason{a = {choices = {x = 'X'}}})
    print(reason{a = {type = 'float', ui = {control = 'dial'}}})
    print(reason())
    sim.writeCustomTableData(sim.getObject '.', '__config__', {a = 99, zz = 1})
end

function sysCall_nonSimulation()
    if pass > 0 then print(pass, count, block().a, block().b, block().zz) end
    if pass == 1 then print(sim.readCustomTableData(sim.getObject '.', '__info__').modelType) end
    pass = pass + 1
    if pass == 4 then sim.writeCustomTableData(sim.getObject '.', '__config__', {a = 7}) end
    if pass == 8 then settings.config.a = 9 end
    if pass == 11 then sim.quitSimulator() end
end
