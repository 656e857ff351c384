"""Swanilda: a headless robot simulator that runs CoppeliaSim's scripts and scenes, in-process.

    import swanilda

    with swanilda.Simulator('robot.ttt', seed=1) as s:
        sim = s.require('sim')
        joint = sim.getObject('/arm/joint')
        s.start()
        while s.time < 3:
            s.step()
"""

import atexit
import os

from ._property import Cases, property
from ._simulator import Script, Simulator
from ._swanilda import Error, Snapshot, __version__, close_all, forget_after_fork

__all__ = ["Cases", "Error", "Script", "Simulator", "Snapshot", "__version__", "property"]

# The scripts of simulators that are still open clean up while Python can run them.
atexit.register(close_all)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=forget_after_fork)
