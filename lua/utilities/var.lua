--[[
Variables by dotted name, local variables of a running function, and texts with values in braces: getvar, setvar, getlocals, f.

Every script has them as globals from the start. This module is there for scripts that require it: it changes nothing and returns nothing.
]]
