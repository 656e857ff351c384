--[[
Functions over functions and tables: map, filter, reduce and their kin, and the operators as functions.

Every script has them as globals from the start. This module is there for scripts that require it: it changes nothing and returns nothing.
]]
