--[[
Old home of a few helpers for interactive use, which are global functions now.

    hexdump(data), printbytes(data)     prints bytes
    rerequire(name)                     loads a module again
    apropos(input, pos)                 what a line being typed may go on with
]]

local console = require 'swanilda.console'

return {
    hexdump = console.hexdump,
    printbytes = console.printBytes,
    rerequire = require('swanilda.modload').rerequire,
    apropos = console._getCompletion,
}
