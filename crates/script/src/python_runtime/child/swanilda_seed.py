"""Random numbers that follow from the simulator's seed: those of `random` and the global ones of NumPy.

Both take a start of their own from the system when they are imported. The hashes of texts, which decide the order of sets, have the same
seed: the simulator starts Python with it (PYTHONHASHSEED).
"""
import random
import sys
from importlib.machinery import PathFinder

NUMPY = 'numpy.random'


class SeededLoader:
    """Loads a module as its own loader does, then seeds it."""

    def __init__(self, loader, seed):
        self.loader = loader
        self.seed = seed

    def create_module(self, spec):
        return self.loader.create_module(spec)

    def exec_module(self, module):
        module.__loader__ = module.__spec__.loader = self.loader
        self.loader.exec_module(module)
        module.seed(self.seed)


class Finder:
    """Finds NumPy's random numbers where Python looks for all modules. Importing them takes time, and most scripts need none."""

    def __init__(self, seed):
        self.seed = seed

    def find_spec(self, name, path=None, target=None):
        spec = PathFinder.find_spec(name, path, target) if name == NUMPY else None
        if spec is not None and spec.loader is not None:
            spec.loader = SeededLoader(spec.loader, self.seed)
        return spec


def begin(seed):
    random.seed(seed)
    if NUMPY in sys.modules:
        sys.modules[NUMPY].seed(seed)
    else:
        sys.meta_path.insert(0, Finder(seed))
