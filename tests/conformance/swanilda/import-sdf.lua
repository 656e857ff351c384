-- simSDF: models and worlds of SDF files
sim = require 'sim'
simSDF = require 'simSDF'

local function write(text)
    local name = os.tmpname() .. '.sdf'
    local file <close> = io.open(name, 'w')
    file:write(text)
    return name
end

local function show(label, ...)
    local words = {}
    for _, value in ipairs{...} do
        for _, item in ipairs(type(value) == 'table' and value or {value}) do
            words[#words + 1] = math.type(item) == 'float' and (string.format('%.6f', item):gsub('^%-(0%.0+)$', '%1')) or tostring(item)
        end
    end
    print(label .. ': ' .. table.concat(words, ' '))
end

local function names(tree)
    local list = {}
    for _, handle in ipairs(sim.getObjectsInTree(tree)) do list[#list + 1] = sim.getObjectAlias(handle) end
    return table.concat(list, ' ')
end

local inertial = '<inertial><mass>2</mass><inertia><ixx>.1</ixx><iyy>.2</iyy><izz>.3</izz></inertia></inertial>'
local box = '<collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry></collision>'
local arm = [[<model name="arm"><pose>1 2 0 0 0 0</pose>
 <joint name="anchor" type="fixed"><parent>world</parent><child>base</child></joint>
 <link name="base">]] .. inertial .. box .. [[</link>
 <link name="fore"><pose>0 0 .5 0 0 0</pose>]] .. inertial .. box .. [[</link>
 <link name="ball"><pose>0 0 .9 0 0 0</pose><collision name="c"><geometry><ellipsoid><radii>.1 .2 .3</radii></ellipsoid></geometry></collision></link>
 <joint name="elbow" type="revolute"><parent>base</parent><child>fore</child><pose>0 0 -.2 0 0 0</pose>
  <axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>2</upper><effort>7</effort></limit></axis></joint>
 <joint name="wrist" type="universal"><parent>fore</parent><child>ball</child><axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>
</model>]]

-- A world: models stay where they are; what is fixed to the world, or static, does not move.
simSDF.import(write('<sdf version="1.9"><world name="w"><gravity>0 0 -1.62</gravity>' .. arm ..
    '<model name="wall"><static>true</static><pose>0 5 0 0 0 0</pose><link name="w">' .. box .. '</link></model></world></sdf>'))
local base, wall = sim.getObject('/base_respondable'), sim.getObject('/w_respondable')
show('base', sim.getObjectPosition(base), sim.getObjectInt32Param(base, sim.shapeintparam_static), sim.getModelProperty(base))
show('wall', sim.getObjectPosition(wall), sim.getObjectInt32Param(wall, sim.shapeintparam_static))
print(names(base))
local elbow, fore = sim.getObject('/elbow'), sim.getObject('/fore_respondable')
show('elbow', sim.getObjectPosition(elbow), sim.getJointInterval(elbow))
show('motor', sim.getJointTargetForce(elbow), sim.getObjectInt32Param(elbow, 2039))
show('fore', sim.getObjectPosition(fore), sim.getShapeMass(fore), sim.getObjectInt32Param(fore, sim.shapeintparam_static))
show('between', sim.getShapeMass(sim.getObject('/wrist_cross_respondable')))
show('ball', sim.getObjectPosition(sim.getObject('/ball_respondable')), sim.getShapeMass(sim.getObject('/ball_respondable')))

-- A model alone is centred, and stands on the floor; options.
simSDF.import(write('<sdf version="1.9"><model name="one"><pose>3 3 3 0 0 0</pose><link name="one">' .. inertial .. box .. '</link></model></sdf>'),
    {prepareModel = false, hideCollisionLinks = false, noSelfCollision = false})
local one = sim.getObject('/one_respondable')
show('one', sim.getObjectPosition(one), sim.getModelProperty(one) & sim.modelproperty_not_model > 0, sim.getObjectInt32Param(one, 10), sim.getObjectInt32Param(one, 3019))

simSDF.dump(write('<sdf version="1.9"><model name="one"><link name="a"/></model></sdf>'))
for _, arguments in ipairs{{'/nowhere.sdf'}, {write '<robot/>'}, {write '<sdf/>', {hideJoints = 1}}} do
    local ok, reason = pcall(simSDF.import, table.unpack(arguments))
    print(ok, (tostring(reason):gsub('^.-simSDF%.import: ', ''):gsub('/tmp/[^:]*', 'FILE')))
end
