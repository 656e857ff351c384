--[[
Old home of a few helpers for interactive use, which are global functions now.
]]

local console = require 'console'

return {
    hexdump = console.hexdump,
    printbytes = console.printBytes,
    rerequire = require('modload').rerequire,
    apropos = console._getCompletion,
}
