--[[
Makes the classes of matrix-2 global, and says that CoppeliaSim has deprecated them. The library does it here: a script may have a module matrix.
]]

for name, class in pairs(require 'matrix-2') do _G[name] = class end

addLog(430, '"matrix" module is deprecated. please use simEigen') -- sim.verbosity_scriptwarnings; sim may not be loaded
