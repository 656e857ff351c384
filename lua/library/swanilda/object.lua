--[[
What `require 'sim.Object'` returns: the class of objects, which CoppeliaSim 4.10 has but cannot make an object of.
]]

local MESSAGE <const> = 'sim.Object makes no objects in CoppeliaSim 4.10: use handles, as in sim'

return setmetatable({}, {
    __call = function() error(MESSAGE, 2) end,
    __tostring = function() return 'class Object' end,
})
