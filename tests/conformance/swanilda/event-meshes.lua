-- topic: events
-- as: sandbox
-- passes: 0
-- loops: 8
-- spec: events 1
-- note: the meshes of a shape come after it and go before it
sim = require 'sim'
sim.createScript(sim.scripttype_customization, [[
sim = require 'sim'
cbor = require 'org.conman.cbor'
n = 0
function sysCall_nonSimulation()
    n = n + 1
    if n == 2 then H = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1}) U = sim.getObjectUid(H) end
    if n == 3 then sim.setShapeColor(H, nil, sim.colorcomponent_ambient_diffuse, {1, 0, 0}) end
    if n == 4 then sim.scaleObject(H, 2, 2, 2) end
    if n == 5 then sim.removeObjects({H}) end
end
function sysCall_event(b)
    if n < 2 then return end
    for _, e in ipairs(cbor.decode(tostring(b))) do
        local what = e.uid == U and 'shape' or e.handle == e.uid and e.uid and e.uid > 0 and 'mesh'
        if what and e.event == 'objectAdded' then
            print(n, e.event, what, e.data.objectType, e.data.shapeUid == U, e.data.vertices and #e.data.vertices)
        elseif what then
            local keys = {}
            for k in pairs(e.data) do keys[#keys + 1] = k end
            table.sort(keys)
            print(n, e.event, what, table.concat(keys, ' '))
        end
    end
end
]], 0, 'lua')
