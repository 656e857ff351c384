--[[
Checks the arguments of a function in Lua and fills in defaults. Loading this makes checkargs and checkargsEx global; it returns nothing.

    local a, b = checkargs({{type = 'float'}, {type = 'bool', default = true}}, ...)

Fields of a type: type (any float int string bool table func handle object union), default, default_nil, nullable,
size (a number, or text like '2..*'), item_type, class, union (a list of types).
Does not convert anything: a value is accepted or refused.
]]

local check = require 'checkargs.check'

checkargs, checkargsEx = check.checkargs, check.checkargsEx
