"""The functions of the simulator as Python code sees them: modules by `require`, their functions and constants."""
import copy

import swanilda_link as link

call = link.call


class Method:
    """A function of the simulator."""

    __slots__ = ('_name',)

    def __init__(self, name):
        self._name = name

    def __call__(self, *args):
        return call(self._name, args)

    def __repr__(self):
        return '<function %s of the simulator>' % self._name

    @property
    def __name__(self):
        return self._name

    @property
    def __doc__(self):
        return call('__help__', [self._name])


class Namespace:
    """A module of the simulator. Its members are asked for when they are first used."""

    def __init__(self, path):
        self.__dict__['_path'] = path

    def __getattr__(self, name):
        if name.startswith('__') and name.endswith('__'):
            raise AttributeError(name)
        path = '%s.%s' % (self._path, name)
        kind, value = call('__member__', [path])
        if kind == 'function':
            value = LOCAL.get(path) or Method(path)
        elif kind == 'table':
            value = Namespace(path)
        elif kind != 'constant':
            raise AttributeError("module '%s' has no attribute '%s'" % (self._path, name))
        self.__dict__[name] = value
        return value

    def __dir__(self):
        return sorted(set(call('__members__', [self._path])) | set(self.__dict__) - {'_path'})

    def __repr__(self):
        return '<module %s of the simulator>' % self._path


# Modules that scripts use without asking for them, as those in Lua may (lua_runtime/implicit.rs).
IMPLICIT = (
    'simIK simUI simGeom simMujoco simAssimp simBubble simCHAI3D simMTB simOMPL simOpenMesh simQHull simRRS1 simSDF simSubprocess simSurfRec '
    'simURDF simVision simWS simZMQ simIM simEigen simIGL simICP simROS simROS2'
).split()


class ImplicitNamespace(Namespace):
    """A module that is loaded when it is first used."""

    def __getattr__(self, name):
        if '_is_loaded' not in self.__dict__ and not name.startswith('__'):
            self.__dict__['_is_loaded'] = True
            call('__require__', [self._path])
        return super().__getattr__(name)


class ScriptFunctions:
    """The functions of another script, as methods."""

    def __init__(self, handle):
        self._handle = handle

    def __getattr__(self, name):
        return lambda *args: call('sim.callScriptFunction', (name, self._handle) + args)


def script_functions(handle, *script_type):
    return ScriptFunctions(call('__script__', (handle,) + script_type))


# What works without the simulator, or with objects of this process only.
LOCAL = {
    'sim.getScriptFunctions': script_functions,
    'sim.copyTable': copy.deepcopy,
}

namespaces = {}


def require(name):
    """A module of the simulator, which also becomes a global of the script."""
    path = call('__require__', [name])
    if path not in namespaces:
        namespaces[path] = Namespace(path)
    script_globals[path] = namespaces[path]
    return namespaces[path]


script_globals = {}
