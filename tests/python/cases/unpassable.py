#python
# Values that a script of the simulator cannot have are errors of the call, which the script may catch.


def sysCall_init():
    sim = require('sim')
    for value in ({(1, 2): 3}, {'a': {(1, 2): 3}}, {None: 1}):
        try:
            sim.setTableProperty(sim.handle_scene, 'customData.x', value)
        except Exception as error:
            print('caught', error)
    print('alive')
    print(sim.testCB(1, lambda a, b: 'fine', 2, 1))
    try:
        sim.testCB(1, lambda a, b: {(): 1}, 2, 1)
    except Exception as error:
        print('caught', str(error).splitlines()[0])
    print('still alive')


def sysCall_thread():
    try:
        sim.setTableProperty(sim.handle_scene, 'customData.x', {(1, 2): 3})
    except Exception as error:
        print('caught in the thread', error)
    print('ends')
