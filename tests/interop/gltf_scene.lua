-- Writes scenes with everything that glTF files can contain into a folder.
sim = require 'sim'
simGLTF = require 'simGLTF'
simAssimp = require 'simAssimp'

function sysCall_init()
    folder = sim.getNamedStringParam('folder')
    picture = sim.createShape(64, 0, {0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 1, 2}, nil, {0, 0, 1, 0, 1, 1}, string.rep('\255\0\0', 8), {4, 2})
    glass = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.3, 0.3, 0.4})
    sim.setObjectPosition(glass, {0, 0, 0.5})
    sim.setShapeColor(glass, nil, sim.colorcomponent_ambient_diffuse, {1, 0.5, 0.2})
    sim.setShapeColor(glass, nil, sim.colorcomponent_transparency, {0.5})
    local falling = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.3, 0.3, 0.4})
    sim.setObjectInt32Param(falling, sim.shapeintparam_static, 0)
    sim.setObjectPose(falling, {1, 0, 0.9, 0, 0.6, 0, 0.8})
    local eye = sim.createVisionSensor(2, {64, 32, 0, 0}, {0.125, 10, 1, 0.05, 0, 0, 0, 0, 0, 0, 0})
    sim.setObjectParent(eye, falling, true)
    simGLTF.recordAnimation(true)
end

function sysCall_actuation()
    if sim.getSimulationTime() > 0.8 then sim.stopSimulation() end
end

function sysCall_afterSimulation()
    simGLTF.recordAnimation(false)
    simGLTF.exportAllObjects()
    simGLTF.exportAnimation()
    simGLTF.saveBinary(folder .. '/scene.glb')
    simGLTF.saveASCII(folder .. '/scene.gltf')
    simAssimp.exportShapes({glass, picture}, folder .. '/shapes.glb', 'glb2')
    simGLTF.clear()
    simGLTF.saveBinary(folder .. '/empty.glb')
end
