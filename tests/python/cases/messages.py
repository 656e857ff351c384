#python
#luaExec eventCallback = true


def sysCall_init():
    global sim, other
    sim = require('sim')
    self.events = 0
    other = sim.createScript(sim.scripttype_customization, OTHER, 0, 'python')
    sim.initScript(other)
    sim.broadcastMsg({'id': 'hello', 'data': [1, 2]})
    sim.setStringProperty(sim.handle_scene, 'signal.word', 'from Python')
    print(sim.waitForSignal(sim.handle_scene, 'word'))
    sim.setInt32Signal('old', 42)
    print(sim.getInt32Signal('old'))
    sim.setBufferProperty(sim.handle_scene, 'customData.raw', b'\x00\x01')
    print(sim.getBufferProperty(sim.handle_scene, 'customData.raw'))
    sim.writeCustomTableData(sim.handle_scene, 'table', {'a': [1, 2.5]})
    print(sim.readCustomTableData(sim.handle_scene, 'table'))


def sysCall_event(events):
    self.events += 1


def sysCall_msg(message, origin):
    if message['id'] == 'answer':
        print('answer', message['data'])


def sysCall_nonSimulation():
    if self.events:
        print('events come')
        sim.quitSimulator()


OTHER = '''
def sysCall_init():
    global sim
    sim = require('sim')

def sysCall_event(events):
    print('not enabled')

def sysCall_msg(message, origin):
    if message['id'] == 'hello':
        print('heard', message, origin >= 0)
        sim.broadcastMsg({'id': 'answer', 'data': {'x': 1}})
'''
