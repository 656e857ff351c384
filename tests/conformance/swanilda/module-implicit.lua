-- topic: modules
-- as: customization
-- passes: 0
-- spec: libraries 1; what a helper loads for itself leaves the modules that a script uses without asking as they are
require 'utils'
require 'logger'
require 'configUi'
print(sim.getSimulationTime(), type(simIK.createEnvironment), utils)
require 'matrix-utils'
print(type(simGeom), Vector3({1, 2, 3})[2])
sim = require 'sim'
print(simUI)
