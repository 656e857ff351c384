--[[
What `require 'sim.Object'` returns: the class of objects, which CoppeliaSim 4.10 has but cannot make an object of.
]]

local MESSAGE <const> = 'sim.Object works from CoppeliaSim 4.11 on: use handles, as in sim'

return setmetatable({}, {
    __call = function() error(MESSAGE, 2) end,
    __tostring = function() return 'class Object' end,
})
