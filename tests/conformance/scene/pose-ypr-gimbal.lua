-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: poses 3
-- tol: 1e-6
-- topic: poses
sim = require 'sim'
local case = require 'lib.case'
local P = case.P
local a,b,g=sim.yawPitchRollToAlphaBetaGamma(0.4,math.pi/2,0.1)
P('abg', a,b,g)
P('ypr', sim.alphaBetaGammaToYawPitchRoll(a,b,g))
