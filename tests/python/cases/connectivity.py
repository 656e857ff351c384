#python

def sysCall_init():
    global sim
    sim = require('sim')
    sender = sim.createScript(sim.scripttype_customization, SENDER, 0, 'python')
    sim.setObjectAlias(sender, 'sender')
    sim.initScript(sender)
    self.sender = sender
    # Signals: properties of the application, a scene or an object.
    sim.setIntProperty(sim.handle_app, 'signal.myInteger', 42)
    sim.setTableProperty(sim.handle_scene, 'signal.myTable', {'a': [1, 2], 'b': 'text'})
    print(sim.getIntProperty(sim.handle_app, 'signal.myInteger'), sim.getTableProperty(sim.handle_scene, 'signal.myTable'))
    sim.removeProperty(sim.handle_app, 'signal.myInteger')
    print(sim.getIntProperty(sim.handle_app, 'signal.myInteger', {'noError': True}))
    # Custom data, and packed tables.
    sim.setTableProperty(sim.handle_scene, 'customData.config', {'gains': [1.5, 2], 'name': 'arm'})
    print(sim.getTableProperty(sim.handle_scene, 'customData.config'))
    data = sim.packTable([1, 'two', {'three': 3.0}])
    print(type(data).__name__, sim.unpackTable(data))
    print(sim.unpackFloatTable(sim.packFloatTable([0.5, 0.25])), sim.unpackInt32Table(sim.packInt32Table([1, -2])))
    print(sim.callScriptFunction('add', sender, 1, 2), sim.getScriptFunctions(sender).add(3, 4))
    sim.broadcastMsg({'id': 'question', 'data': {'number': 21}})


def sysCall_msg(message, origin):
    if message['id'] == 'reply':
        print('reply', message['data'], origin == self.sender)


def sysCall_nonSimulation():
    print('signal', sim.waitForSignal(sim.handle_scene, 'ready'))
    sim.quitSimulator()


SENDER = '''
def sysCall_init():
    global sim
    sim = require('sim')


def add(a, b):
    return a + b


def sysCall_msg(message, origin):
    if message['id'] == 'question':
        sim.broadcastMsg({'id': 'reply', 'data': 2 * message['data']['number']})
        sim.setStringProperty(sim.handle_scene, 'signal.ready', 'set')
'''
