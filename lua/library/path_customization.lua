--[[
Customization script of path objects: `path = require('path_customization')`. The path is updated when its control points, dummies
below it, move while the simulation is stopped, and when it starts. `path.shaping(points, closed, upVector)` may create the shape along it.

Does not open the dialog of a path: there is no display.
]]

local model = require 'swanilda.pathmodel'
sim = package.loaded.sim or require 'sim' -- scripts find it as a global, as in the original
local path = {}

-- The script is an object below the path; in scenes from before there were such, it belongs to the path itself.
local function owner()
    local object = sim.getObject('.')
    local isScript = sim.getObjectType(object) == sim.sceneobject_script
    return isScript and sim.getObjectParent(object) or object
end

local function update() model.update(owner(), path.shaping) end

function sysCall_nonSimulation() update() end

function sysCall_beforeSimulation()
    update()
    model.setHidden(owner(), true)
end

function sysCall_afterSimulation() model.setHidden(owner(), false) end

return path
