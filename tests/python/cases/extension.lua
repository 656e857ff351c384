-- A script in Python whose sysCall_ext gets all calls, and calls by language.
local sim = require 'sim'

local PYTHON = [==[
#luaExec function hidden(x) return 'Lua', x end
#luaExec function shown(x) return 'Lua', x end
def sysCall_init():
    pass

def sysCall_ext(name, *args):
    if name in ('missing', 'hidden'):
        return '_*funcNotFound*_'
    if name == 'broken':
        return '_*runtimeError*_'
    if name == 'fail':
        raise ValueError('in sysCall_ext')
    return [name] + list(args)

def shown(x):
    return ['Python', x]
]==]

function sysCall_init()
    local python = sim.createScript(sim.scripttype_customization, PYTHON, 0, 'python')
    sim.setObjectAlias(python, 'python')
    sim.initScript(python)
    local function ask(name, ...) return sim.callScriptFunction(name, python, ...) end
    print(ask('anything', 1, {2, 3}))
    print(ask('shown', 1))
    print(ask('shown@python', 2))
    print(ask('shown@lua', 3))
    print(ask('hidden', 4))
    print(pcall(ask, 'missing'))
    print(pcall(ask, 'broken'))
    sim.initScript(python)
    print(pcall(ask, 'fail'))
    sim.quitSimulator()
end
