--[[
Extensions of the table library: comparing, slicing, joining, flattening.

They are functions of `table` from the start. This module is there for scripts that require it: it returns nothing.
]]
