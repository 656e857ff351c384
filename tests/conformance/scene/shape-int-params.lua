-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: shapes 7
-- tol: 1e-9
-- topic: shapes
sim = require 'sim'
local case = require 'lib.case'
local P = case.P
local s=sim.createPrimitiveShape(3,{.1,.1,.1}) sim.setObjectInt32Param(s,sim.shapeintparam_respondable_mask,0x12345) P('mask 16 bit', sim.getObjectInt32Param(s,sim.shapeintparam_respondable_mask))
for _,n in ipairs{'static','respondable','kinematic','culling','wireframe','edge_visibility'} do local id=sim['shapeintparam_'..n] if id then local a=sim.getObjectInt32Param(s,id) sim.setObjectInt32Param(s,id,1-(a or 0)) P(n..' '..id, a, sim.getObjectInt32Param(s,id)) end end
for i,n in ipairs{'init_velocity_x','init_velocity_y','init_velocity_z','init_ang_velocity_x','init_ang_velocity_y','init_ang_velocity_z'} do local id=sim['shapefloatparam_'..n] if id then sim.setObjectFloatParam(s,id,i) P(n..' '..id, sim.getObjectFloatParam(s,id)) end end
