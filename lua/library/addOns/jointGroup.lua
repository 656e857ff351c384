--[[
Groups of joints of a model: `require('addOns.jointGroup').getJointGroups(model)`.
]]

local sim = _quietRequire 'sim'
local jointGroup = {}

--- The objects below a model that are groups of joints.
-- @return handles
function jointGroup.getJointGroups(model)
    local groups = {}
    for _, object in ipairs(sim.getObjectsInTree(model)) do
        local mark = sim.readCustomStringData(object, '__jointGroup__')
        if object ~= model and mark and #mark > 0 then groups[#groups + 1] = object end
    end
    return groups
end

return jointGroup
