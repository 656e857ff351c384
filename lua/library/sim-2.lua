--[[
The functions of sim, under the name of a later generation of the interface.

That generation works with objects instead of handles; it was in the making in CoppeliaSim 4.10, and of it only the name is here.
]]

addLog(430, 'sim-2 has been loaded') -- sim.verbosity_scriptwarnings; sim may not be loaded

return setmetatable({}, {__index = _quietRequire('sim')})
