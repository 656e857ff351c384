--[[
The names that an expression of a debugger sees: variables of a function, then global ones. Internal.
]]

local get, set, globals = ...

return setmetatable({}, {
    __index = function(_, name)
        local found, value = get(name)
        if found then return value end
        return globals[name]
    end,
    __newindex = function(_, name, value)
        if not set(name, value) then globals[name] = value end
    end,
})
