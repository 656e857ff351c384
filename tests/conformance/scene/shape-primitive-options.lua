-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: shapes 2
-- tol: 1e-7
-- topic: shapes
sim = require 'sim'
local case = require 'lib.case'
local P, X = case.P, case.X
for o=0,15 do local s=sim.createPrimitiveShape(sim.primitiveshape_cylinder,{.2,.2,.4},o) local v,i=sim.getShapeMesh(s) P('opt '..o, (sim.getShapeGeomInfo(s)), sim.getObjectInt32Param(s,sim.shapeintparam_culling), sim.getObjectInt32Param(s,sim.shapeintparam_edge_visibility), sim.getObjectFloatParam(s,3025), sim.getObjectFloatParam(s,3026), #v//3, #i//3) end
X('bad type', sim.createPrimitiveShape,99,{1,1,1}) X('zero size', sim.createPrimitiveShape,3,{0,1,1}) X('table', sim.createPrimitiveShape,3,{1,1})
