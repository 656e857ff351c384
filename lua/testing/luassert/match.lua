--[[
Matchers: stand for values of a kind among the arguments of `called_with`, `returned_with` and `on_call_with`.

    local match = require 'luassert.match'
    match._                             any value
    match.is_number()                   also string, boolean, table, function, thread, userdata, true, false, nil, truthy, falsy
    match.is_equal(x), match.is_same(x), match.is_ref(x)        ==; alike; the very object, not a copy of it
    match.is_near(x, tolerance), match.matches(pattern [, init, plain]), match.has_match(...), match.is_unique([deep])
    match.is_all_of(m, ...), match.is_any_of(m, ...), match.is_none_of(m, ...)
    match.is_not_number(), match.is_not.equal(x), ...           not and no negate
    match.is_matcher(x)
    match.is_string()(value)            whether it matches

Own matchers: see assert:register in luassert.
]]

local chain = require 'luassert.chain'
local formatters = require 'luassert.formatters'

local Matcher = formatters.Matcher

function Matcher:__call(...) return not self.callback(...) == not self.mod end

local match = {_ = setmetatable({mod = true, callback = function() return true end}, Matcher)}

-- @api bool result = luassert.match.is_matcher(any value)
function match.is_matcher(value) return type(value) == 'table' and getmetatable(value) == Matcher end
-- @api bool result = luassert.match.is_ref_matcher(any value)
function match.is_ref_matcher(value) return match.is_matcher(value) and value.name == 'ref' end

local USER_LEVEL <const> = 3

local function callState(state, ...)
    local modifiers, entry = chain.parse('matcher', state.tokens)
    if not modifiers then error(("luassert: unknown modifier/matcher: '%s'"):format(entry), 2) end
    local arguments = table.pack(...)
    state = chain.modify(state, modifiers, not entry and arguments, USER_LEVEL)
    if not entry then return state end
    local callback = entry.callback(state, arguments, USER_LEVEL)
    return setmetatable({name = entry.name, callback = callback, mod = state.mod, arguments = arguments}, Matcher)
end

local State = chain.metatable(callState)

-- @api table state = luassert.match.state()
function match.state() return chain.start(State) end

return setmetatable(match, {__index = function(_, key) return chain.extend(chain.start(State), key) end})
