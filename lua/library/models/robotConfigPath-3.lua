--[[
Paths of robots, states of joints one after the other, as objects of the scene: `require('models.robotConfigPath-3').create(states, parent, jointGroup)` (spec: models 6).
]]

local sim = _quietRequire 'sim'
local robotConfigPath = {}

-- States as a list: rows of a matrix or columns of it, whichever have as many values as there are joints.
local function list(states, count)
    if type(states) ~= 'table' then error('a matrix of states is needed', 3) end
    local isMatrix = type(states.rows) == 'function'
    local rows = isMatrix and states:rows() or #states
    local result = {}
    if isMatrix and states:cols() == count then
        for i = 1, rows do result[i] = states:rowdata(i) end
    elseif isMatrix and rows == count then
        for i = 1, states:cols() do result[i] = states:coldata(i) end
    elseif not isMatrix then
        result = states
    end
    if #result == 0 or #result[1] ~= count then error(('states of %d values are needed'):format(count), 3) end
    return result
end

--- Makes the object of a path.
-- @param states a matrix, or a list of lists of positions
-- @param parent object it is put below
-- @param jointGroup the group of joints
-- @return handle of a script object with the alias Path
function robotConfigPath.create(states, parent, jointGroup)
    local all = list(states, #sim.getReferencedHandles(jointGroup))
    local path = sim.createScript(sim.scripttype_customization, "require 'models.robotConfigPath_customization'")
    sim.setObjectAlias(path, 'Path')
    sim.setObjectParent(path, parent, false)
    sim.setReferencedHandles(path, {jointGroup}, 'jointGroup')
    sim.writeCustomTableData(path, 'path', all)
    local state = sim.createScript(sim.scripttype_customization, "require 'models.robotConfig_customization-3'")
    sim.setObjectAlias(state, 'State')
    sim.setObjectParent(state, path, false)
    sim.setReferencedHandles(state, {jointGroup}, 'jointGroup')
    sim.writeCustomTableData(state, 'config', all[1])
    return path
end

return robotConfigPath
