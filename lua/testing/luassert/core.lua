--[[
The callable `assert`: its chains, how they end, and what can be registered. The assertions themselves are in the other files.
]]

local chain = require 'luassert.chain'
local failure = require 'luassert.failure'
local formatters = require 'luassert.formatters'
local say = require 'luassert.say'
local shared = require 'luassert.state'

local luassert = {}

-- What `assert:level` makes.
local Level = {}

function luassert:level(level)
    level = level or 1
    if math.type(level) ~= 'integer' then error('luassert: a level is a whole number', 2) end
    return setmetatable({level = level}, Level)
end

function luassert:get_level(value)
    return type(value) == 'table' and getmetatable(value) == Level and value.level or nil
end

function luassert:register(kind, name, callback, positive, negative)
    local entry = {name = name, callback = callback, positive_message = positive, negative_message = negative}
    chain.register(kind, name, entry)
end

function luassert:unregister(kind, name) chain.register(kind, name, nil) end

function luassert:add_formatter(formatter) shared.add_formatter(formatter) end
function luassert:remove_formatter(formatter) shared.remove_formatter(formatter) end
function luassert:set_parameter(name, value) shared.set_parameter(name, value) end
function luassert:get_parameter(name) return shared.get_parameter(name) end
function luassert:add_spy(spy) shared.add_spy(spy) end
function luassert:snapshot() return shared.snapshot() end
function luassert:format(list) return formatters.format(list) end

-- The text of a key: ours, or that of another `say` a suite may have brought.
local function translate(key, values)
    local text = say(key, values)
    local other = package.loaded.say
    if text == nil and key ~= nil and other and other ~= say then text = other(key, values) end
    return text
end

local function customText(message)
    local metatable = debug.getmetatable(message)
    if type(message) == 'table' and metatable and metatable.__tostring then return tostring(message) end
    return type(message) == 'string' and message or formatters.format{message, n = 1}[1]
end

local function failureText(state, entry, arguments)
    local key = state.mod and entry.positive_message or entry.negative_message
    local text = key and translate(key, formatters.format(arguments))
    local message = rawget(state, 'failure_message')
    if message == nil then return text or 'assertion failed!' end
    return customText(message) .. (text and '\n' .. text or '')
end

-- Takes the level from the end of the arguments, if it is there.
local function takeLevel(arguments)
    local level = luassert:get_level(arguments[arguments.n])
    if level == nil then return 1 end
    arguments[arguments.n] = nil
    arguments.n = arguments.n - 1
    return level
end

-- What a chain gives for its arguments: the results, or nil, a message and the level of the function to blame.
local function evaluate(state, arguments)
    local level = takeLevel(arguments)
    local modifiers, entry = chain.parse('assertion', state.tokens)
    if not modifiers then error(("luassert: unknown modifier/assertion: '%s'"):format(entry), level + 2) end
    state = chain.modify(state, modifiers, not entry and arguments, level + 3)
    if not entry then return {state, n = 1} end
    local passed = table.move(arguments, 1, arguments.n, 1, {n = arguments.n})
    local holds, results = entry.callback(state, arguments, level + 3)
    if not holds == not state.mod then return results or passed end
    return nil, failureText(state, entry, arguments), level
end

local function callState(state, ...)
    local results, message, level = evaluate(state, table.pack(...))
    if not results then failure.raise(message, level + 1) end
    return table.unpack(results, 1, results.n or #results)
end

local State = chain.metatable(callState)

function luassert:state() return chain.start(State) end

local function callAssert(_, ...)
    local value, message, level = ...
    if value then return ... end
    if message == nil then message = 'assertion failed!' end
    failure.raise(message, (luassert:get_level(level) or 1) + 1)
end

setmetatable(luassert, {
    __call = callAssert,
    __index = function(_, key) return chain.extend(chain.start(State), key) end,
})

return luassert
