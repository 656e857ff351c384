--[[
Texts by key and language, with places for values: where the messages of luassert come from.

    local say = require 'say'
    say:set_namespace('en')                 the language that `set` writes and `say` reads
    say:set('greeting', 'Hello %s')
    say('greeting', {'world'})              Hello world; values are formatted as by string.format, `n` in the list says how many
    say:set_fallback('en')                  where to look for what the language lacks

`say` gives nil for a key nobody set. A script's own `say.lua` goes before this one.
]]

return require 'luassert.say'
