-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: joints 5
-- tol: 1e-8
-- topic: joints
sim = require 'sim'
local case = require 'lib.case'
local P = case.P
local K=sim.jointmode_kinematic local a,b=sim.createJoint(sim.joint_revolute,K,0),sim.createJoint(sim.joint_revolute,sim.jointmode_dependent,0)
P('none', sim.getJointDependency(b)) sim.setJointDependency(b,a,0.1,2) sim.setJointPosition(a,0.3) P('q', sim.getJointPosition(b)) local m,o,c=sim.getJointDependency(b) P('dep', m==a, o, c)
sim.setJointPosition(b,1) P('temporary', sim.getJointPosition(b)) sim.setJointPosition(a,0.3) P('again', sim.getJointPosition(b)) sim.setJointPosition(a,0.31) P('other', sim.getJointPosition(b))
sim.setJointPosition(a,2.5) P('beyond pi', sim.getJointPosition(b)) sim.setJointInterval(b,false,{-0.1,0.2}) sim.setJointPosition(a,1) P('own interval', sim.getJointPosition(b))
sim.setJointMode(b,K) P('mode change', (sim.getJointDependency(b))) sim.setJointPosition(a,0) P('kept', sim.getJointPosition(b))
