-- topic: functions of the time of V-REP
-- as: customization
-- passes: 0
-- spec: scene-files 7.3
-- note: what scripts of old scenes call
function sysCall_init()
    print(sim.getObjectHandle(sim.handle_self) == sim.getScript(sim.handle_self))
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
    print(sim.getObjectFloatParameter(box, sim.objfloatparam_objbbox_max_x))
    print(sim.getObjectInt32Parameter(box, sim.objintparam_visibility_layer))
    print(sim.setShapeColor('@backCompatibility1:' .. box, nil, 0, {1, 0, 0}))
    sim.setScriptAttribute(sim.handle_self, sim.customizationscriptattribute_activeduringsimulation, false)
    print(pcall(simGetUIHandle, 'dialog'))
    print(pcall(simGet2DElementButtonProperty, -1, 1))
    print(simBoolOr16(1, sim_ui_property_moveable))
    print(sim.handleModule(sim.handle_all, false), sim.getModuleName(0), sim.getIkGroupHandle('ik@silentError'))

    sim.sendData(sim.handle_chain, 0, 'ground sensors', 'abc')
    print(sim.receiveData(0, 'ground sensors'))
    print(sim.receiveData(0, 'ground sensors'))

    local points = sim.addDrawingObject(sim.drawing_points, 3, 0, -1, 100, {1, 0, 0})
    print(sim.addDrawingObjectItem(points, {0, 0, 0}), sim.addDrawingObjectItem(points, nil))
    sim.removeDrawingObject(points)
    print(pcall(sim.addDrawingObjectItem, points, {0, 0, 0}))
    print(pcall(sim.addGraphStream, box, 'speed', 'm/s'))
    print(Matrix{{1, 2}, {3, 4}}[2][1])
    math.randomseed(0.5)
    print(simIsDeprecated('sim.getObject'), simGetRealTimeSimulation(), sim.getRealTimeSimulation(), simSetThreadResumeLocation(0, 0))
end
