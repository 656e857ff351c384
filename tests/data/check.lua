-- Loads `-D file=` and looks whether all is there that world.lua (or kinds.simscene.xml, on which it builds) put in. `-D part=true` for part.ttm.
sim = require 'sim'
local file, isPart = sim.getNamedStringParam('file'), sim.getNamedStringParam('part')

local KINDS <const> = 'shape 7, joint 6, graph 1, camera 1, light 1, dummy 3, path 1, proximitysensor 1, visionsensor 1, forcesensor 1, octree 2, '
    .. 'pointcloud 2, script 3'
local checks = 0
local function same(what, value, wanted)
    checks = checks + 1
    if getAsString(value) ~= getAsString(wanted) then error(('%s: %s, not %s'):format(what, getAsString(value), getAsString(wanted)), 0) end
end

-- Angles and colours lose digits in some forms.
local function near(what, value, wanted)
    checks = checks + 1
    if type(value) == 'table' then
        same('length of ' .. what, #value, #wanted)
        for i = 1, #wanted do near(what, value[i], wanted[i]) end
    elseif not (math.abs(value - wanted) < 1e-5) then
        error(('%s: %s, not %s'):format(what, value, wanted), 0)
    end
end

local function count(kind) return #sim.getObjectsInTree(sim.handle_scene, kind) end

local function checkBox(box)
    near('mass', sim.getShapeMass(box), 3)
    same('static', sim.getObjectInt32Param(box, sim.shapeintparam_static), 0)
    same('respondable', sim.getObjectInt32Param(box, sim.shapeintparam_respondable), 1)
    same('mask', sim.getObjectInt32Param(box, sim.shapeintparam_respondable_mask), 0xff00)
    near('initial velocity', sim.getObjectFloatParam(box, sim.shapefloatparam_init_velocity_z), 0.25)
    near('friction', sim.getEngineFloatParam(sim.bullet_body_friction, box), 0.25)
    local _, colour = sim.getShapeColor(box, nil, sim.colorcomponent_ambient_diffuse)
    near('colour', colour, {1, 0.5, 0})
    local size = sim.getShapeBB(box)
    near('size', size, {0.1, 0.2, 0.3})
    near('slider', sim.getJointPosition(sim.getObject('./slider', {proxy = box})), 0.25)
    same('script', sim.getObjectType(sim.getObjectChild(box, 0)) == sim.sceneobject_script
        or sim.getObjectType(sim.getObjectChild(box, 1)) == sim.sceneobject_script, true)
end

local function checkData(target)
    same('int', sim.getIntProperty(target, 'customData.int'), 7)
    same('long', sim.getLongProperty(target, 'customData.long'), 1 << 40)
    near('float', sim.getFloatProperty(target, 'customData.float'), 0.1)
    same('bool', sim.getBoolProperty(target, 'customData.bool'), true)
    same('string', sim.getStringProperty(target, 'customData.string'), 'text')
    near('floats', sim.getFloatArrayProperty(target, 'customData.floats'), {1.5, 2.5})
    same('map', sim.getTableProperty(target, 'customData.map'), {a = 1, b = {2, 3}})
end

local function checkOwnData(box)
    checkData(box)
    same('bytes', sim.readCustomStringData(box, 'bytes'), 'a\0b')
    same('table', sim.readCustomTableData(box, 'table'), {1, 'two', deep = {true, 2.5}})
end

local function checkShapes()
    local vertices, indices = sim.getShapeMesh(sim.getObject('/mesh'))
    same('mesh', {#vertices, #indices}, {12, 12})
    near('mass of a mesh', sim.getShapeMass(sim.getObject('/mesh')), 0.5)
    same('members of a group', #sim.ungroupShape(sim.getObject('/group')), 3)
    local view = sim.getShapeViz(sim.getObject('/square'), 0)
    same('texture', view.texture and view.texture.resolution, {2, 2})
    same('texture on a shape', sim.getShapeTextureId(sim.getObject('/square')) >= 0, true)
end

local function checkJoints()
    local elbow = sim.getObject('/elbow')
    local cyclic, interval = sim.getJointInterval(elbow)
    same('cyclic', cyclic, false)
    near('interval', interval, {-1, 2})
    same('control', sim.getObjectInt32Param(elbow, sim.jointintparam_dynctrlmode), sim.jointdynctrl_position)
    near('force', sim.getJointTargetForce(elbow), 12)
    near('target', sim.getJointTargetPosition(elbow), 0.5)
    local turn = sim.getObjectChildPose(sim.getObject('/ball'))
    near('turn', {turn[6], turn[7]}, {math.sin(0.5), math.cos(0.5)})
    local master, offset, coefficient = sim.getJointDependency(sim.getObject('/base/slave'))
    same('master', sim.getObjectAlias(master), 'motor')
    near('law', {offset, coefficient}, {0.5, 2})
end

local function checkOthers()
    same('voxels', #sim.getOctreeVoxels(sim.getObject('/voxels')) // 3, 2)
    same('points', #sim.getPointCloudPoints(sim.getObject('/cloud')) // 3, 3)
    local _, _, _, times, heights = sim.getGraphCurve(sim.getObject('/graph'), 0, 0)
    near('times', times, {0.1, 0.2, 0.3})
    near('heights', heights, {1, 4, 9})
    same('resolution', sim.getVisionSensorRes(sim.getObject('/vision')), {64, 32})
    same('explicit', sim.getExplicitHandling(sim.getObject('/vision')), 1)
    near('gravity', sim.getArrayParam(sim.arrayparam_gravity), {0, 0, -3.7})
    near('time step', sim.getFloatParam(sim.floatparam_simulation_time_step), 0.02)
    same('engine', sim.getInt32Param(sim.intparam_dynamic_engine), sim.physics_ode)
    local friends = {}
    for i, handle in ipairs(sim.getReferencedHandles(sim.getObject('/box'), 'friends')) do friends[i] = sim.getObjectAlias(handle) end
    same('references', friends, {'mesh', 'voxels'})
    local code = sim.getStringProperty(sim.getObject('/mesh/script'), 'code')
    same('script', code, "function sysCall_init()\n    sim = require 'sim'\n    seen = 'customization'\nend\n")
end

local function checkWorld()
    same('loaded', sim.loadScene(file), 1)
    local kinds = {}
    for _, name in ipairs {'shape', 'joint', 'graph', 'camera', 'light', 'dummy', 'path', 'proximitysensor', 'visionsensor', 'forcesensor', 'octree',
        'pointcloud', 'script'} do
        kinds[#kinds + 1] = name .. ' ' .. count(sim['sceneobject_' .. name])
    end
    same('objects', table.concat(kinds, ', '), KINDS)
    checkBox(sim.getObject('/box'))
    checkOwnData(sim.getObject('/box'))
    checkData(sim.handle_scene)
    checkShapes()
    checkJoints()
    checkOthers()
end

if isPart then
    local box = sim.loadModel(file)
    same('a model', sim.getModelProperty(box) & sim.modelproperty_not_model, 0)
    checkBox(box)
    checkOwnData(box)
else
    checkWorld()
end
print(checks .. ' checks')
