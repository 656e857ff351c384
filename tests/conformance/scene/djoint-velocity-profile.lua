-- as: simulation
-- passes: 34
-- engine: bullet278
-- spec: joints 7
-- tol: 0.026
-- agrees: bullet278 bullet283 ode newton mujoco
-- topic: dynjoints
sim = require 'sim'
local case = require 'lib.case'
local P = case.P
local bodies = require 'lib.bodies'
local arm = bodies.arm
function sysCall_init() n=0 J = arm(0.01) sim.setObjectInt32Param(J,2039,sim.jointdynctrl_velocity) sim.setObjectInt32Param(J,2040,1) sim.setJointTargetForce(J,1000) sim.setJointTargetVelocity(J,1,{2,20}) end
function sysCall_sensing() n=n+1 if n==4 or n==8 or n==12 or n==30 then P('pass '..n, sim.getJointVelocity(J)) end end
