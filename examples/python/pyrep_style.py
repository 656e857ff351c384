"""A robot-learning loop on the library of CoppeliaSim 4.1, in the way of PyRep: steps with four cameras, colours, depths and masks.

    swanilda library ~/coppeliasim
    COPPELIASIM_ROOT=~/coppeliasim python3 examples/python/pyrep_style.py

Only ctypes is needed. What PyRep does with the library is the same: see docs/PYREP.md.
"""

import ctypes
import math
import os
import threading
import time

ROOT = os.path.expanduser(os.environ["COPPELIASIM_ROOT"])
STEPS, SIDE = 200, 128

lib = ctypes.CDLL(os.path.join(ROOT, "libcoppeliaSim.so"))
Float, Int = ctypes.c_float, ctypes.c_int
lib.simGetVisionSensorImage.restype = lib.simGetVisionSensorDepthBuffer.restype = ctypes.c_void_p
lib.simGetLastError.restype = ctypes.c_char_p
lib.simReleaseBuffer.argtypes = [ctypes.c_void_p]
lib.simGetSimulationTime.restype = Float


def floats(*values):
    return (Float * len(values))(*values)


def checked(result):
    """A result that is no error."""
    if result == -1:
        raise RuntimeError(lib.simGetLastError().decode())
    return result


class Simulator:
    """One thread waits in the launch; the one that makes this drives the simulator."""

    def __init__(self, scene=""):
        arguments = (b"example", 0, scene.encode(), ROOT.encode())
        self.waiting = threading.Thread(target=lib.simExtLaunchUIThread, args=arguments, daemon=True)
        self.waiting.start()
        while not lib.simExtCanInitSimThread():
            time.sleep(0.001)
        checked(lib.simExtSimThreadInit())

    def step(self):
        checked(lib.simExtStep(True))

    def shut_down(self):
        lib.simExtPostExitRequest()
        checked(lib.simExtSimThreadDestroy())
        self.waiting.join()


class Camera:
    """A vision sensor that is handled when its pictures are asked for."""

    def __init__(self, position, angles, coded=False):
        perspective, explicit = 2, 1
        settings = floats(0.01, 5.0, math.radians(60), 0.1, 0, 0, 0, 0, 0, 0, 0)
        self.handle = checked(
            lib.simCreateVisionSensor(perspective | explicit, (Int * 4)(SIDE, SIDE, 0, 0), settings, None)
        )
        lib.simSetObjectPosition(self.handle, -1, floats(*position))
        lib.simSetObjectOrientation(self.handle, -1, floats(*angles))
        if coded:
            render_mode, coded_handles = 1017, 2
            checked(lib.simSetObjectInt32Parameter(self.handle, render_mode, coded_handles))

    def look(self):
        checked(lib.simHandleVisionSensor(self.handle, None, None))

    def colours(self):
        """Red, green, blue of each pixel, from 0 to 1, the lowest row first."""
        return self.values(lib.simGetVisionSensorImage(self.handle), 3 * SIDE * SIDE)

    def depths(self):
        """From 0 at the near to 1 at the far clipping plane."""
        return self.values(lib.simGetVisionSensorDepthBuffer(self.handle), SIDE * SIDE)

    def values(self, address, count):
        if not address:
            raise RuntimeError(lib.simGetLastError().decode())
        values = (Float * count)()
        ctypes.memmove(values, address, ctypes.sizeof(values))
        lib.simReleaseBuffer(address)
        return values


def main():
    simulator = Simulator()
    for number in range(5):
        box = lib.simCreatePureShape(0, 8, floats(0.1, 0.1, 0.1), Float(0.5), None)
        lib.simSetObjectPosition(box, -1, floats(0.15 * number - 0.3, 0, 0.3 + 0.1 * number))
    above = [(0.3 * x, 0.3 * y, 1.5) for x in (-1, 1) for y in (-1, 1)]
    cameras = [Camera(position, (math.pi, 0, 0)) for position in above]
    masks = [Camera(position, (math.pi, 0, 0), coded=True) for position in above]
    lib.simStartSimulation()
    began = time.perf_counter()
    for _ in range(STEPS):
        simulator.step()
    steps = time.perf_counter() - began
    began = time.perf_counter()
    for _ in range(STEPS):
        simulator.step()
        for camera in cameras:
            camera.look()
            camera.colours()
            depths = camera.depths()
        for camera in masks:
            camera.look()
            mask = camera.colours()
    pictures = time.perf_counter() - began
    print(f"a step: {1e3 * steps / STEPS:.3f} ms, with four cameras (colours, depths, masks): {1e3 * pictures / STEPS:.3f} ms")
    print(f"{lib.simGetSimulationTime():.2f} s simulated; the nearest pixel is at {min(depths):.3f} of the range, masks have {len(set(mask))} levels")
    simulator.shut_down()


main()
