-- as: customization
-- passes: 12
-- engine: bullet278
-- spec: import 5
-- tol: 1e-6
-- topic: shapes
sim = require 'sim'
simGLTF = require 'simGLTF'

local stem = os.tmpname()
local glb, gltf = stem .. '.glb', stem .. '.gltf'

local function world(h)
    local p = sim.getObjectPose(h)
    if p[7] < 0 then for i = 4, 7 do p[i] = -p[i] end end
    for i, x in ipairs(p) do p[i] = string.format('%.6f', x + 0.0):gsub('^%-(0%.0+)$', '%1') end
    return table.concat(p, ' ')
end
local function describe(h)
    local parent = sim.getObjectParent(h)
    local line = {sim.getObjectAlias(h), sim.getObjectType(h), parent == -1 and '-' or sim.getObjectAlias(parent), world(h)}
    if sim.getObjectType(h) == sim.sceneobject_shape then
        local _, c = sim.getShapeColor(h, nil, sim.colorcomponent_ambient_diffuse)
        local _, e = sim.getShapeColor(h, nil, sim.colorcomponent_emission)
        local _, t = sim.getShapeColor(h, nil, sim.colorcomponent_transparency)
        local v, i = sim.getShapeMesh(h)
        local low, high = {1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}
        for k, x in ipairs(v) do
            local a = (k - 1) % 3 + 1
            low[a], high[a] = math.min(low[a], x), math.max(high[a], x)
        end
        local function list(l) local s = {} for k, x in ipairs(l) do s[k] = string.format('%.4f', x) end return table.concat(s, ' ') end
        line[#line + 1] = list(c) .. ', ' .. list(e) .. ', ' .. list(t) .. ', ' .. #i // 3 .. ' triangles, ' .. list(low) .. ' to ' .. list(high)
    end
    return table.concat(line, ' | ')
end

-- a tree: a turned base, a joint, an arm of two meshes, a camera, a light, a dummy, a hidden shape
local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.3, 0.1})
sim.setObjectAlias(base, 'base')
sim.setShapeColor(base, nil, sim.colorcomponent_ambient_diffuse, {1, 0.5, 0.25})
sim.setShapeColor(base, nil, sim.colorcomponent_emission, {0, 0, 0.125})
sim.setObjectPose(base, {1, 2, 3, 0, 0.6, 0, 0.8})
local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
sim.setObjectAlias(joint, 'joint')
sim.setObjectPosition(joint, {0, 0, 0.5}, base)
sim.setObjectParent(joint, base, true)
sim.setJointPosition(joint, 0.5)
local a = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.1, 0.1, 0.4})
local b = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2})
sim.setObjectPosition(b, {0, 0, 0.3})
sim.setShapeColor(b, nil, sim.colorcomponent_transparency, {0.5})
local arm = sim.groupShapes({b, a})
sim.setObjectAlias(arm, 'arm')
sim.setObjectParent(arm, joint, false)
sim.setObjectPose(arm, {0.3, 0, 0, 0, 0, 0, 1}, joint)
local camera = sim.createVisionSensor(2, {64, 32, 0, 0}, {0.125, 10, 1, 0.05, 0, 0, 0, 0, 0, 0, 0})
sim.setObjectAlias(camera, 'eye')
sim.setObjectParent(camera, arm, false)
sim.setObjectPose(camera, {0, 0.1, 0, 0.5, 0.5, 0.5, 0.5}, arm)
local dummy = sim.createDummy(0.01)
sim.setObjectAlias(dummy, 'tip')
sim.setObjectParent(dummy, camera, false)
sim.setObjectPose(dummy, {0, 0, 0.25, 0, 0, 0, 1}, camera)
local hidden = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
sim.setObjectAlias(hidden, 'hidden')
sim.setObjectInt32Param(hidden, sim.objintparam_visibility_layer, 256)

-- there and back, in both forms
simGLTF.clear()
simGLTF.exportObjects({arm, base, joint, camera, dummy, hidden})
print('saved', simGLTF.saveBinary(glb), simGLTF.saveASCII(gltf))
for _, h in ipairs {base, joint, arm, camera, dummy, hidden} do print(describe(h)) end
for _, load in ipairs {'loadBinary', 'loadASCII'} do
    print(load, simGLTF[load](load == 'loadBinary' and glb or gltf))
    local handles = simGLTF.importObjects()
    for _, h in ipairs(handles) do print(describe(h)) end
    if load == 'loadBinary' then
        local _, pixels = sim.getObjectInt32Param(handles[4], sim.visionintparam_resolution_x), nil
        print('angle', string.format('%.6f %.6f', sim.getObjectFloatParam(camera, sim.visionfloatparam_perspective_angle),
            sim.getObjectFloatParam(handles[4], sim.camerafloatparam_perspective_angle)))
    end
    sim.removeObjects(handles)
end

-- numbers of nodes, and shapes on their own
simGLTF.clear()
print('nodes', simGLTF.exportObject(base), simGLTF.exportObject(arm), simGLTF.exportShape(hidden), simGLTF.exportShape(arm, base, 1))
local handles = simGLTF.importObjects()
for i, h in ipairs(handles) do print(i, sim.getObjectAlias(h), sim.getObjectParent(h) == handles[1], world(h) == world(arm)) end
sim.removeObjects(handles)
sim.setObjectSel({base})
simGLTF.clear()
simGLTF.exportSelectedObjects()
print('selected', #simGLTF.importObjects())
simGLTF.clear()
print('empty', #simGLTF.importObjects(), simGLTF.serialize():match('"version":"(.-)"'))

-- textures
print(simGLTF.getExportTextureFormat())
simGLTF.setExportTextureFormat(simGLTF.TextureFormat.jpg)
print(simGLTF.getExportTextureFormat())
simGLTF.setExportTextureFormat(simGLTF.TextureFormat.png)
local textured = sim.createShape(64, 0, {0,0,0, 1,0,0, 1,1,0}, {0, 1, 2}, nil, {0,0, 1,0, 1,1}, string.rep('\255\0\0', 8), {4, 2})
simGLTF.exportObjects({textured})
simGLTF.exportShape(textured)
local _, images = simGLTF.serialize():gsub('image/png', '')
print('one picture', images)
print('texture', sim.readTexture(sim.getShapeTextureId(simGLTF.importObjects()[1]), 0):sub(1, 3) == '\255\0\0')

-- refusals
local function refusal(label, f, ...)
    local ok, e = pcall(f, ...)
    print(label, ok and 'no error' or tostring(e):gsub('\nstack traceback.*', ''):gsub('^.-: ', ''))
end
local function load(label, f, name)
    local result, warnings, errors = f(name)
    print(label, result, warnings, (errors:gsub(stem:gsub('%p', '%%%0'), 'FILE')))
end
load('form', simGLTF.loadASCII, glb)
load('other form', simGLTF.loadBinary, gltf)
load('nothing', simGLTF.loadBinary, stem .. '.nothing')
local f = io.open(gltf, 'w')
f:write('{"asset":{"version":"2.0"},"nodes":[{"mesh":3}]}')
f:close()
load('damaged', simGLTF.loadASCII, gltf)
refusal('node', simGLTF.exportShape, base, -1, 99)
refusal('parent', simGLTF.exportShape, base, 123456)
refusal('no shape', simGLTF.exportShape, joint)
refusal('object', simGLTF.exportObjects, {base, 123456})
refusal('format', simGLTF.setExportTextureFormat, 3)

-- an animation
simGLTF.recordAnimation(true)
simGLTF.clear()
simGLTF.exportObjects({base, joint, arm, camera})

function sysCall_sensing()
    sim.setJointPosition(joint, math.min(5, 10 * sim.getSimulationTime()))
end
function sysCall_afterSimulation()
    simGLTF.recordAnimation(false)
    simGLTF.exportAnimation()
    local text = simGLTF.serialize()
    local _, channels = text:gsub('"path":"', '')
    print('frames', simGLTF.animationFrameCount() > 3, 'channels', channels, text:match('"path":"(.-)"'))
    print('node of the arm', text:match('"channels":%[.-"node":(%d+)'))
    os.remove(glb) os.remove(gltf) os.remove(stem)
end
function sysCall_actuation() if sim.getSimulationTime() > 0.4 then sim.stopSimulation() end end
