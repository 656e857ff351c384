--[[
Extensions of the math library: what Lua 5.1 to 5.3 had, and a few more.

They are functions of `math` from the start. This module is there for scripts that require it: it returns nothing.
]]
