import time


def sysCall_init():
    global sim
    sim = require('sim')
    self.steps = 0
    self.free = sim.createScript(sim.scripttype_simulation, FREE, 0, 'python')
    sim.setObjectAlias(self.free, 'free')


def sysCall_sensing():
    self.steps += 1


def sysCall_thread():
    sim.setStepping(True)
    first = self.steps
    time.sleep(0.05)
    print('nothing ran meanwhile', self.steps == first)
    for _ in range(3):
        sim.step()
    print('three steps', self.steps - first)
    assert sim.setStepping(False) == 1
    before = self.steps
    while self.steps == before:
        time.sleep(0.01)
        sim.getSimulationTime()
    print('steps go on beside it')
    sim.acquireLock()
    before = self.steps
    time.sleep(0.02)
    sim.getSimulationTime()
    print('locked', self.steps == before)
    sim.releaseLock()
    print('called while it sleeps', sim.callScriptFunction('count', self.free) > 0)
    sim.stopSimulation()
    while not sim.getSimulationStopping():
        sim.step()
    print('the end')
    sim.quitSimulator()


FREE = '''
import time

def sysCall_init():
    global sim, n
    sim = require('sim')
    n = 0

def count():
    return n + 1

def sysCall_actuation():
    global n
    n += 1

def sysCall_thread():
    while not sim.getSimulationStopping():
        time.sleep(0.001)
        sim.getSimulationTime()
'''
