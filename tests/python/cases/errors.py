def sysCall_init():
    global sim
    sim = require('sim')
    texts = {
        'no function': 'x = 1',
        'syntax': '#python\nimport os\ndef f(:\n    pass\n',
        'import': 'import no_such_module_anywhere\n',
        'init': 'def sysCall_init():\n    g()\n\ndef g():\n    raise ValueError("bad\\nvalue")\n',
        'lua': '#luaExec error("in Lua")\ndef sysCall_init(): pass\n',
        'exit': 'import sys\ndef sysCall_init():\n    sys.exit(3)\n',
        'wrong type': 'def sysCall_init():\n    sim.getObjectPosition({1, 2})\n',
        'result': 'def sysCall_init():\n    pass\ndef f():\n    return 1 << 70\n',
    }
    for name, text in texts.items():
        print('---', name)
        script = sim.createScript(sim.scripttype_customization, text, 0, 'python')
        sim.setObjectAlias(script, 'script')
        sim.initScript(script)
        if name == 'result':
            print(sim.callScriptFunction('f', script))
        sim.removeObjects([script])


def sysCall_nonSimulation():
    sim.quitSimulator()
