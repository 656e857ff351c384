-- spec: import 1
sim = require 'sim'
simURDF = require 'simURDF'

local head = [[<?xml version="1.0"?><robot name="r2">
<link name="base"><inertial><mass value="1"/><inertia ixx=".01" ixy="0" ixz="0" iyy=".02" iyz="0" izz=".03"/></inertial>
 <collision><geometry><box size=".2 .2 .1"/></geometry></collision></link>
<link name="arm"><inertial><origin xyz="0 0 .2" rpy="0 0 1.5707963267948966"/><mass value=".5"/><inertia ixx=".001" ixy="0" ixz="0" iyy=".002" iyz="0" izz=".003"/></inertial>
 <collision><origin xyz="0 0 .2"/><geometry><box size=".1 .1 .4"/></geometry></collision></link>]]
local function robot(joint)
    return head .. '<joint name="j" ' .. joint .. '</joint></robot>'
end
local ends = '<parent link="base"/><child link="arm"/><origin xyz="0 0 .05"/><axis xyz="0 1 0"/>'
local limited = 'type="revolute">' .. ends .. '<limit lower="-1" upper="2" effort="10" velocity="3"/>'

local function show(label, ...)
    local parts = {}
    local function add(value)
        if type(value) == 'table' then
            for _, inner in ipairs(value) do add(inner) end
        elseif math.type(value) == 'float' then
            parts[#parts + 1] = (string.format('%.6f', value):gsub('^%-(0%.0+)$', '%1'))
        else
            parts[#parts + 1] = tostring(value)
        end
    end
    for i = 1, select('#', ...) do add((select(i, ...))) end
    print(label .. ': ' .. table.concat(parts, ' '))
end
local made
local function import(text, options)
    if made then sim.removeObjects(made) end
    local before = {}
    for _, handle in ipairs(sim.getObjectsInTree(sim.handle_scene)) do before[handle] = true end
    local name, roots = simURDF.import(text, options)
    made = {}
    for _, handle in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        if not before[handle] then made[#made + 1] = handle end
    end
    return name, roots
end
local base, joint, arm
local function get()
    base, joint, arm = sim.getObject('/base_respondable'), sim.getObject('/j'), sim.getObject('/arm_respondable')
end

-- I1 to I4
local name, roots = import(robot(limited), 0)
get()
show('name', name, #roots, roots[1] == base)
show('base', sim.getObjectPosition(base), sim.getShapeMass(base), sim.getObjectInt32Param(base, 3003), sim.getObjectInt32Param(base, 3004), sim.getObjectInt32Param(base, 3019), sim.getObjectInt32Param(base, 10))
show('model', sim.getModelProperty(base), sim.getModelProperty(arm))
local m = sim.getObjectMatrix(joint)
show('joint', sim.getObjectPosition(joint), m[3], m[7], m[11])
show('interval', sim.getJointInterval(joint))
show('motor', sim.getJointTargetForce(joint), sim.getObjectFloatParam(joint, 2036), sim.getObjectInt32Param(joint, 2039), sim.getObjectInt32Param(joint, 10))
show('arm', sim.getObjectPosition(arm), sim.getObjectParent(arm) == joint)
local inertia, com = sim.getShapeInertia(arm)
show('inertia', inertia[1], inertia[5], inertia[9], com[4], com[8], com[12])

-- I5: the position is kept
import(robot(limited), 32)
get()
show('kept', sim.getObjectPosition(base), sim.getObjectPosition(joint))

-- I6: masks; other options
import(robot(limited), 128)
get()
show('masks', sim.getObjectInt32Param(base, 3019), sim.getObjectInt32Param(arm, 3019))
import(robot(limited), 1 + 2 + 64 + 256)
get()
show('visible', sim.getObjectInt32Param(base, 10), sim.getObjectInt32Param(joint, 10), sim.getModelProperty(base), sim.getObjectInt32Param(joint, 2039))
import(robot(limited), 1024)
get()
show('frames', sim.getObjectPosition(arm, joint))
import(robot(limited), 8)
show('copies', sim.getObjectParent(sim.getObject('/arm_visual')) == sim.getObject('/arm_respondable'), sim.getObjectInt32Param(sim.getObject('/arm_visual'), 10), sim.getObjectInt32Param(sim.getObject('/arm_visual'), 3004))

-- I7 and I8: kinds of joints
import(robot('type="fixed">' .. ends), 0)
get()
show('fixed', sim.getObjectType(joint))
import(robot('type="continuous">' .. ends), 0)
get()
show('continuous', sim.getJointType(joint), sim.getJointTargetForce(joint), sim.getJointInterval(joint))
import(robot('type="prismatic">' .. ends), 0)
get()
show('prismatic', sim.getJointType(joint), sim.getJointTargetForce(joint), sim.getObjectFloatParam(joint, 2036), sim.getJointInterval(joint))
import(robot('type="revolute">' .. ends), 0)
get()
show('revolute', sim.getJointTargetForce(joint), sim.getJointInterval(joint))
import(robot('type="floating">' .. ends), 0)
get()
show('floating', sim.getObjectType(joint))

-- A joint whose limits leave 0 out is at the nearest one, and its child with it.
import(robot('type="revolute">' .. ends .. '<limit lower="1" upper="2"/>'), 32)
get()
show('nearest', sim.getJointPosition(joint), sim.getObjectPosition(arm))

-- I11: a mesh is as large as its scale says, also where CoppeliaSim drops factors that enlarge
local mesh = os.tmpname() .. '.obj'
local out <close> = io.open(mesh, 'w')
out:write('v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n')
out:flush()
for _, scale in ipairs {'1 1 1', '2 2 2', '.5 .5 .5', '1 1 -1'} do
    import('<?xml version="1.0"?><robot name="m"><link name="a"><inertial><mass value="1"/><inertia ixx=".1" ixy="0" ixz="0" iyy=".1" iyz="0" izz=".1"/></inertial><collision><geometry><mesh filename="' .. mesh .. '" scale="' .. scale .. '"/></geometry></collision></link></robot>', 32)
    local shape = sim.getObject('/a_respondable')
    local vertices, indices = sim.getShapeMesh(shape)
    local low, high = math.huge, -math.huge
    for i = 3, #vertices, 3 do low, high = math.min(low, vertices[i]), math.max(high, vertices[i]) end
    show('scale ' .. scale, low, high, #indices // 3, sim.getObjectInt32Param(shape, 3003))
end

-- A file goes out and comes back.
local file = os.tmpname() .. '.urdf'
import(robot(limited), 0)
get()
sim.setJointPosition(joint, 0.5)
simURDF.export(base, file)
local name = import('<?xml version="1.0"?>' .. io.open(file):read('a'):gsub('^.-?>', ''), 0)
get()
show('again', name, sim.getObjectPosition(joint), sim.getObjectPosition(arm), sim.getShapeMass(arm), sim.getJointInterval(joint))
local inertia = sim.getShapeInertia(arm)
show('inertia', inertia[1], inertia[5], inertia[9])
local name, roots = simURDF.importFile(file, 0)
show('importFile', name, #roots)

for _, bad in ipairs {'/nowhere/x.urdf', '<?xml version="1.0"?><sdf/>', '<?xml version="1.0"?><robot><xacro:if/></robot>'} do
    local ok, reason = pcall(simURDF.import, bad)
    print(ok, (tostring(reason):gsub('^.-simURDF%.import: ', '')))
end
