--[[
Pieces of MuJoCo's model, whichever engine the scene selects.

There is no MuJoCo here: soft things become soft shapes as those of simSoft, constraints become pins and loop closures, tendons and sites become dummies, what is said of joints, bodies and contacts become parameters of objects, gravity and time step of `<option>`
those of the scene. What has no counterpart is named once in the log, with the number of the injection. An injection becomes objects when the physics next moves the scene; they go
with it, with the script that added it, and at the end of the simulation.

`info` of all of them: `shapeHandle` (a shape) or `element` ('worldbody', or the name of a body as `getInfo` has it): what it is on, in whose frame it is; `callback`: a function, or the name of one, that gets `info` when the
injection becomes objects, and may return a table of values that change it.
]]

local _, native = ...
local check = require 'checkargs.check'

local simMujoco = {}
for _, name in ipairs {'removeInjection', 'getFlexcompInfo', 'getCompositeInfo', 'getInfo'} do simMujoco[name] = native[name] end

local INFO <const> = {{type = 'table'}}
local XML_AND_INFO <const> = {{type = 'string'}, {type = 'table'}}

-- What can be passed on, and the callback.
local function split(info)
    local plain = {}
    for key, value in pairs(info) do
        if key ~= 'callback' then plain[key] = value end
    end
    return plain, info.callback
end

--- Adds something soft: a rope (nodes along one axis), a cloth (two) or a volume (three).
-- @api int injectionId = simMujoco.addFlexcomp(map info)
-- @param info beside what all have: `name` (unique), `type` ('grid', 'square', 'disc', 'box', 'cylinder', 'ellipsoid', 'direct'), `count` (three numbers of nodes), `spacing` (three distances, m), `radius` (m), `mass` (kg, of all), `pose` (seven numbers), `pin` (nodes that do
-- not move, from 0), `extraFlexcompXml` (attributes of `<flexcomp>` as a text), `extraXml` (elements within it: `<edge>`, `<elasticity>`, `<contact>`, `<pin>`, `<plugin>`)
-- @return injectionId from 1
function simMujoco.addFlexcomp(...)
    return native.addFlexcomp(split(check(INFO, ...)))
end

--- Adds something soft in the older form: `cable`, or of MuJoCo before 3: `rope`, `cloth`, `grid`, `box`, `cylinder`, `ellipsoid`.
-- @api int injectionId = simMujoco.composite(string xml, map info)
-- @param xml a `<composite>` element
-- @param info beside what all have: `prefix` (unique), `type`, `count`, `respondableMask`, `grow` (m, for getCompositeInfo)
-- @return injectionId from 1
function simMujoco.composite(...)
    local xml, info = check(XML_AND_INFO, ...)
    return native.composite(xml, split(info))
end

--- Adds elements of MJCF. These act: `<flexcomp>`, `<composite>`, `<connect>`, `<weld>`, gravity and time step of `<option>`, `<site>`, tendons (`<fixed>`, `<spatial>`), actuators (`motor`, `position`, `velocity`, `general`, `adhesion`),
-- `<exclude>`, `<pair>`, and `<joint name="...">` of a joint that there is (`armature`, `damping`, `stiffness`, `springref`, `frictionloss`).
-- @api int injectionId = simMujoco.addInjection(map info)
-- @param info beside what all have: `xml`, the elements
-- @return injectionId from 1
function simMujoco.addInjection(...)
    local info = check(INFO, ...)
    if type(info.xml) ~= 'string' then error("an injection needs 'xml', a text.", 2) end
    return native.addInjection(info.xml, split(info))
end

--- Adds elements of MJCF, as addInjection does.
-- @api int injectionId = simMujoco.injectXML(string xml, any where, map info = {})
-- @param xml the elements
-- @param where a shape, or the name of an element
-- @param info beside what all have: nothing
-- @return injectionId from 1
function simMujoco.injectXML(...)
    local xml, where, info = check({{type = 'string'}, {type = 'any'}, {type = 'table', default = {}}}, ...)
    local own = {}
    for key, value in pairs(info) do own[key] = value end
    own[type(where) == 'string' and 'element' or 'shapeHandle'] = where
    return native.addInjection(xml, split(own))
end

--- Takes an injection out of the model again, as removeInjection does.
-- @api simMujoco.removeXML(int injectionId)
-- @param injectionId from injectXML
function simMujoco.removeXML(...) simMujoco.removeInjection(...) end

return simMujoco
