"""Scripts of scenes that run in this interpreter."""

import builtins
import itertools
import marshal
import os
import sys
import types
from importlib.machinery import PathFinder, SourceFileLoader

_numbers = itertools.count(1)
_code = {}  # of the modules that scripts are made of, by name and text
_scripts = {}  # by the name of the package that has the modules from their folders


class Surroundings:
    """What a script finds in this interpreter.

    Modules in its folders are the script's own, as those of a process would be: two scenes may have different modules of one name, and a
    script that starts anew has new ones. They lie in a package that no program has, and see the names that scripts have. All other
    modules are those of the program, also those in the script's folders that the program has imported.
    """

    file = __file__  # whose frames are no part of scripts

    def __init__(self):
        self._package = f"_swanilda_script_{next(_numbers)}"
        self._is_own = {}
        self.names = dict(vars(builtins), __import__=self._import)

    def import_from(self, folders):
        package = types.ModuleType(self._package)
        package.__path__ = list(folders)
        sys.modules[self._package] = package
        _scripts[self._package] = self
        if _Finder not in sys.meta_path:
            sys.meta_path.insert(0, _Finder)

    def set_main(self, module):
        """The main module is the program's."""

    def close(self):
        _scripts.pop(self._package, None)
        for name in [name for name in sys.modules if name.partition(".")[0] == self._package]:
            del sys.modules[name]

    def _import(self, name, globals=None, locals=None, fromlist=(), level=0):
        first = name.partition(".")[0]
        if level > 0 or not self._has(first):
            return builtins.__import__(name, globals, locals, fromlist, level)
        full = f"{self._package}.{name}"
        if fromlist:
            return builtins.__import__(full, globals, locals, fromlist)
        builtins.__import__(full, globals, locals)
        return sys.modules[f"{self._package}.{first}"]

    def _has(self, name):
        if name not in self._is_own:
            self._is_own[name] = self._package in _scripts and self._look(name)
        return self._is_own[name]

    def _look(self, name):
        if name in sys.builtin_module_names:
            return False
        spec = PathFinder.find_spec(name, sys.modules[self._package].__path__)
        if spec is None or spec.loader is None:
            return False  # a folder without modules hides none elsewhere
        program = getattr(sys.modules.get(name), "__file__", None)
        return not (program and spec.origin and os.path.realpath(program) == os.path.realpath(spec.origin))


class _Finder:
    """Finds the modules of scripts."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        script = _scripts.get(name.partition(".")[0])
        spec = PathFinder.find_spec(name, path, target) if script else None
        if spec and type(spec.loader) is SourceFileLoader:
            spec.loader = _Loader(spec.loader.name, spec.loader.path)
            spec.loader.names = script.names
        return spec


class _Loader(SourceFileLoader):
    """Loads a module that sees the names of its script."""

    def exec_module(self, module):
        module.__builtins__ = self.names
        super().exec_module(module)


def start(modules, calls):
    """A script without a text. modules: the names and texts that it is made of, in marshal's format."""
    made = {}

    def import_made(name, *args):
        return made.get(name) or builtins.__import__(name, *args)

    for name, text in marshal.loads(modules):
        made[name] = module = types.ModuleType(name)
        module.__builtins__ = dict(vars(builtins), __import__=import_made)
        if (name, text) not in _code:
            _code[name, text] = compile(text, f"<{name}>", "exec")
        exec(_code[name, text], module.__dict__)
    return made["swanilda_embedded"].Embedded(calls, Surroundings())
