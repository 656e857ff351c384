-- topic: events
-- as: sandbox
-- passes: 0
-- loops: 8
-- spec: events 8, shapes 8
-- note: an image on a shape is told with what the mesh says of it, not with its geometry
sim = require 'sim'
local plane, id = sim.createTexture('', 0, {1, 1}, nil, nil, 0, {2, 1})
local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
local w = sim.createScript(sim.scripttype_customization, string.format([[
sim = require 'sim'
cbor = require 'org.conman.cbor'
PLANE, CUBE, ID, n = %d, %d, %d, 0
function sysCall_nonSimulation()
    n = n + 1
    if n == 2 then sim.setShapeTexture(CUBE, ID, sim.texturemap_cube, 0, {1, 1}) end
    if n == 3 then sim.writeTexture(ID, 0, string.char(0, 0, 0), 0, 0, 1, 1) end
    if n == 4 then sim.setShapeTexture(CUBE, -1, 0, 0, {1, 1}) end
end
function sysCall_event(b)
    if n < 2 then return end
    local lines = {}
    for _, e in ipairs(cbor.decode(tostring(b))) do
        for k, v in pairs(e.data) do
            if k ~= 'time' then
                lines[#lines + 1] = n .. ' ' .. e.event .. ' ' .. k .. ' ' .. (type(v) == 'number' and v - ID or type(v) == 'table' and #v or #tostring(v))
            end
        end
    end
    table.sort(lines)
    print(table.concat(lines, '\n'))
end
]], plane, cube, id), 0, 'lua')
sim.setObjectAlias(w, 'w')
