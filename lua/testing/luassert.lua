--[[
Assertions that say what is wrong, as in busted's luassert 1.9: `assert` is a table that can be called, and chains of words make the assertions.

    local assert = require 'luassert'
    assert(value, message)                          as Lua's own
    assert.are.equal(expected, passed [, message])  ==; also equals
    assert.are.same(expected, passed)               tables alike in all their elements
    assert.is.near(expected, passed, tolerance)
    assert.is_true(x), is_false, is_nil, is_truthy, is_falsy
    assert.is_number(x), is_string, is_boolean, is_table, is_function, is_thread, is_userdata
    assert.is_unique(list [, deep])                 no value twice; deep compares tables by their elements
    assert.matches(pattern, text [, init, plain])            also match; gives what the pattern captures
    assert.has_error(f [, expected])                also error, errors: text without its position, object or table; gives the error
    assert.error_matches(f, pattern [, init, plain])         also error_match, matches_error, match_error
    assert.returned_arguments(n, ...)               n values
    assert.array(t).has.holes([length])             an index without a value
    assert.spy(s).was.called([n]), called_with(...), called_at_least(n), called_at_most(n), called_more_than(n),
        called_less_than(n), returned_with(...)     see luassert.spy

Words of a chain are joined by points or underscores. is, are, was, has and does mean nothing; not and no negate; `message(text)`
goes before the message. Capitals do not count, so that `assert.True` and `assert.Not` need no brackets.

    assert:register('assertion', name, function(state, arguments, level) ... end, positive, negative)
        the function says whether it holds; the others are keys of `say`, whose %s are the arguments. `state.mod` is false after
        a `not`. Second result: a list of what the assertion gives back. An error at `level` is one of the caller
    assert:register('matcher', name, function(state, arguments, level) return function(value) ... end end)
    assert:register('modifier', name, function(state, arguments, level) return state end)
    assert:unregister(kind, name)
    assert:add_formatter(function(value) ... end), assert:remove_formatter(f)       nil leaves the value to the others
    assert:set_parameter(name, value), assert:get_parameter(name)
        TableFormatLevel (3; -1: all), TableFormatShowRecursion (false), TableErrorHighlightCharacter ('*'),
        TableErrorHighlightColor ('none', or red, green, ...)
    local snapshot = assert:snapshot(); snapshot:revert()       takes back spies, stubs, formatters and parameters since
    assert:format{value, n = 1}                     texts of values, as in messages
    assert(false, message, assert:level(2))         the error is that of the caller's caller; also last in any assertion

The message is an error with the position of the caller, or a failure of the test where a test runs.
]]

require 'luassert.languages.en'
require 'luassert.modifiers'
require 'luassert.assertions'
require 'luassert.errors'
require 'luassert.array'
require 'luassert.spy'
require 'luassert.stub'
require 'luassert.mock'
require 'luassert.match'
require 'luassert.matchers'

return require 'luassert.core'
