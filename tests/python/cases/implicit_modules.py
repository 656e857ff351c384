#python
# Modules that nobody asked for are there, as in Lua; an own name goes first.


def sysCall_init():
    print(simIK.createEnvironment() >= 0, simVision.sensorImgToWorkImg.__name__)
    eigen = require('simEigen')
    print(eigen is simEigen, hasattr(simUI, 'create'), hasattr(simUI, 'no_such_function'))
    global simOMPL
    simOMPL = 3
    print(simOMPL)
    try:
        simNothing.f()
    except NameError as error:
        print(error)
