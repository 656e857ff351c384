"""Random numbers that follow from the simulator's seed: those of `random` and the global ones of NumPy, and generators that are made
without a seed (`random.Random()`, `numpy.random.default_rng()`).

All take a start of their own from the system otherwise. The hashes of texts, which decide the order of sets, have the same seed: the
simulator starts Python with it (PYTHONHASHSEED). What asks the system itself (`random.SystemRandom`, `secrets`, `uuid`) stays random.
"""
import functools
import random
import sys
from importlib.machinery import PathFinder

NUMPY = 'numpy.random'


class SeededLoader:
    """Loads a module as its own loader does, then seeds it."""

    def __init__(self, loader, seed, next_seed):
        self.loader = loader
        self.seed = seed
        self.next_seed = next_seed

    def create_module(self, spec):
        return self.loader.create_module(spec)

    def exec_module(self, module):
        module.__loader__ = module.__spec__.loader = self.loader
        self.loader.exec_module(module)
        seed_numpy(module, self.seed, self.next_seed)


class Finder:
    """Finds NumPy's random numbers where Python looks for all modules. Importing them takes time, and most scripts need none."""

    def __init__(self, seed, next_seed):
        self.seed = seed
        self.next_seed = next_seed

    def find_spec(self, name, path=None, target=None):
        spec = PathFinder.find_spec(name, path, target) if name == NUMPY else None
        if spec is not None and spec.loader is not None:
            spec.loader = SeededLoader(spec.loader, self.seed, self.next_seed)
        return spec


def seed_numpy(module, seed, next_seed):
    module.seed(seed)
    make = module.default_rng

    @functools.wraps(make)
    def default_rng(seed=None):
        return make(next_seed() if seed is None else seed)

    module.default_rng = default_rng


def seed_new_generators(next_seed):
    """One that is made, or seeded, without a number gets the next of a series."""
    plain = random.Random.seed

    @functools.wraps(plain)
    def seeded(self, a=None, version=2):
        plain(self, next_seed() if a is None else a, version)

    random.Random.seed = seeded
    # The functions of the module are methods of a generator that were bound before.
    random.seed = functools.partial(seeded, random.seed.__self__)


def begin(seed):
    random.seed(seed)
    series = random.Random(~seed)
    next_seed = functools.partial(series.getrandbits, 64)
    seed_new_generators(next_seed)
    if NUMPY in sys.modules:
        seed_numpy(sys.modules[NUMPY], seed, next_seed)
    else:
        sys.meta_path.insert(0, Finder(seed, next_seed))
