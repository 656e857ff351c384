#python
#luaExec x = 5
#luaExec function double(v) return 2 * v end
import math


def sysCall_init():
    sim = require('sim')
    print('hi', 2)
    self.sensed = 0
    print(sim.getObjectPosition(sim.getObject('/Floor')))
    try:
        sim.getObject('/nope')
    except Exception as e:
        print('caught', e)
    try:
        sim.getObjectPosition(123456)
    except Exception as e:
        print('caught', e)
    print(sim.testCB(1, lambda a, b: a + b, 2, 3))
    print(sim.handle_scene, sim.getSimulationState() == sim.simulation_stopped)
    sim.addLog(sim.verbosity_scriptinfos, 'logged')
    try:
        sim.nonsense
    except AttributeError as e:
        print('AttributeError', e)
    print(sim.callScriptFunction('double@lua', sim.handle_self, 21))
    print(sim.copyTable({'a': [1]}), math.pi)
    sim.protectedCalls(True)
    print('getObjectPosition' in dir(sim), sim.getObject.__name__)


def sysCall_sensing():
    self.sensed += 1
    if self.sensed < 4:
        print('sensing', sim.getSimulationTime())


def sysCall_thread():
    sim.setStepping(True)
    for i in range(3):
        print('thread', i, round(sim.getSimulationTime(), 3))
        sim.step()
    sim.wait(0.2)
    print('waited', round(sim.getSimulationTime(), 3))


def sysCall_cleanup():
    print('bye', self.sensed)
