-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 6, sensors 4
sim = require 'sim'
local o, p = sim.createOctree(0.05, 0, 1), sim.createPointCloud(0.02, 20, 0, 4)
print(sim.getProperty(o, 'objectType'), sim.getProperty(o, 'voxelSize'), #sim.getProperty(o, 'voxels'), #sim.getProperty(o, 'colors'))
print(sim.getObjectFloatParam(o, sim.octreefloatparam_voxelsize))
print(sim.getProperty(p, 'objectType'), sim.getProperty(p, 'cellSize'), sim.getProperty(p, 'maxPointsInCell'), sim.getProperty(p, 'pointSize'), sim.getProperty(p, 'ocTreeStruct'))
sim.setIntProperty(p, 'pointSize', 7) sim.setFloatProperty(p, 'pointDisplayFraction', 0.5) sim.setBoolProperty(p, 'ocTreeStruct', false)
print(sim.getProperty(p, 'pointSize'), sim.getProperty(p, 'pointDisplayFraction'), sim.getProperty(p, 'ocTreeStruct'), #sim.getProperty(p, 'points'))
