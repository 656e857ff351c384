-- A script in Lua and one in Python call each other.
local sim = require 'sim'

local PYTHON = [==[
#python
def sysCall_init():
    global sim
    sim = require('sim')

def add(a, b):
    return a + b

def two():
    return [1, 'b']

def one_list():
    return [[1, 2]]

def nothing():
    pass

def back(name, *args):
    return sim.callScriptFunction(name, caller, *args)

def set_caller(handle):
    global caller
    caller = handle

def deep(n):
    if n == 0:
        return 'bottom'
    return sim.callScriptFunction('deep', caller, n - 1)

def fail():
    raise RuntimeError('on purpose')

def methods():
    lua = sim.getScriptFunctions(caller)
    return lua.triple(5)
]==]

function triple(x) return 3 * x end

function deep(n) return sim.callScriptFunction('deep', python, n) end

function sysCall_init()
    python = sim.createScript(sim.scripttype_customization, PYTHON, 0, 'python')
    sim.setObjectAlias(python, 'python')
    sim.initScript(python)
    local function ask(name, ...) return sim.callScriptFunction(name, python, ...) end
    ask('set_caller', sim_script_handle)
    print(ask('add@python', 1, 2.5), ask('add', 'a', 'b'))
    print(ask('two'))
    print(ask('one_list'))
    print(select('#', ask('nothing')))
    print(ask('back', 'triple', 7))
    print(ask('deep', 3))
    print(ask('methods'))
    print(sim.executeScriptString('[1, 2]', python))
    print(sim.executeScriptString('x = 7', python))
    print(sim.executeScriptString('x * 6@python', python))
    print(pcall(sim.executeScriptString, '1 / 0', python))
    print(sim.getScriptFunctions(python):add(3, 4))
    print(pcall(ask, 'missing'))
    print(pcall(ask, 'fail'))
    sim.quitSimulator()
end
