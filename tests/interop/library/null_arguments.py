"""Every function of a library with NULL for each address, and with handles and numbers that mean nothing: the process lives, a call that
fails says which function it was, and one that works in spite of it is known here.

Usage: null_arguments.py TABLE FOLDER, where TABLE lies beside the tables of symbols; FOLDER is for files.
"""

import ctypes
import math
import os
import pathlib
import sys
import threading
import time

ROOT = os.environ["COPPELIASIM_ROOT"]
IS_OLD = os.path.exists(ROOT + "/simAddOnScript_Stack.lua")
LIBRARY = "libcoppeliaSim.so" if IS_OLD else "libcoppeliaSimHeadless.so"
SYMBOLS = pathlib.Path(sys.argv[1]).parent / ("symbols_41.tsv" if IS_OLD else "symbols_410.tsv")

# Which of them accept a handle, a number or an address that means nothing, because it is ignored or there may be any.
TOLERANT = set("""
_simGetTimeDiffInMs simAddStatusbarMessage simAuxiliaryConsoleClose simAuxiliaryConsolePrint simAuxiliaryConsoleShow
simBuildIdentityMatrix simBuildIdentityMatrix_D simCameraFitToView simCameraFitToView_D simClearDoubleSignal simClearFloatSignal simClearInt32Signal
simClearIntegerSignal simClearStringSignal simCreateBuffer simCreateCollection simCreateCollectionEx simCreateDummy simCreateDummy_D simCreateIkGroup
simCreateOctree simCreateOctree_D simCreatePath simCreatePointCloud simCreatePointCloud_D simCreateVisionSensor simCreateVisionSensor_D simEndDialog
simFloatingViewAdd simFloatingViewAdd_D simFloatingViewRemove simGetDialogInput simGetDialogResult simGetModuleName simGetNameSuffix simGetObjects
simGetObjectSel simGetObjectSelection simGetPersistentDataTags simGetPluginName simGetSceneCustomData simGetSceneCustomDataLength simGetScript
simGetSignalName simGetSimulatorMessage simGetSystemTimeInMs simHandleMechanism simHandleProximitySensor simHandleProximitySensor_D simIsHandle
simIsHandleValid simIsObjectInSelection simMsgBox simQuitSimulator simReadCustomDataBlock simReadCustomDataBlockTags simRefreshDialogs simSerialClose
simSetNameSuffix simSetNavigationMode simSetPage simSetSimulationPassesPerRenderingPass simSetThreadIsFree simTubeClose simTubeRead simTubeStatus
""".split())

TYPES = {
    "i": ctypes.c_int,
    "B": ctypes.c_int,
    "b": ctypes.c_bool,
    "l": ctypes.c_longlong,
    "d": ctypes.c_double,
    "f": ctypes.c_float,
    "v": None,
}
POINTER = ctypes.c_void_p


def types_of(params):
    """The types of the parameters of a row, a count after each list."""
    for param in filter(None, params.split(",")):
        kind = param.lstrip(">=")
        is_value = len(kind) == 1 and kind == param and kind in TYPES
        yield TYPES[kind] if is_value else POINTER
        if len(kind) > 1 and kind.endswith("#"):
            yield ctypes.c_int


def functions(lib):
    """The functions that there are, but those that start and end the simulator."""
    for line in SYMBOLS.read_text().splitlines():
        name, result, params, function = (line.split("\t") + [""] * 3)[:4]
        if function == "-" or function.startswith("launch."):
            continue
        call = getattr(lib, name)
        call.restype = TYPES.get(result, POINTER if result in "SPIDFVW" else ctypes.c_int)
        call.argtypes = list(types_of(params))
        yield name, result, call


def value(kind, integer, number):
    """What a parameter of that type gets: an address NULL."""
    if kind is POINTER:
        return None
    return number if kind in (ctypes.c_double, ctypes.c_float) else kind(integer).value


class Library:
    def __init__(self):
        self.lib = ctypes.CDLL(f"{ROOT}/{LIBRARY}")
        self.lib.simGetLastError.restype = POINTER
        self.lib.simReleaseBuffer.argtypes = [POINTER]

    def last_error(self):
        address = self.lib.simGetLastError()
        text = ctypes.string_at(address).decode()
        self.lib.simReleaseBuffer(address)
        return text

    def start(self):
        root = ROOT.encode()
        if not IS_OLD:
            assert self.lib.simInitialize(root, 0) == 1, self.last_error()
            return
        self.thread = threading.Thread(target=lambda: self.lib.simExtLaunchUIThread(b"", 0, b"", root), daemon=True)
        self.thread.start()
        until = time.monotonic() + 60
        while self.lib.simExtCanInitSimThread() != 1:
            assert time.monotonic() < until
            time.sleep(0.01)
        assert self.lib.simExtSimThreadInit() == 1, self.last_error()

    def end(self):
        if not IS_OLD:
            return self.lib.simDeinitialize()
        self.lib.simExtSimThreadDestroy()
        self.thread.join(60)

    def is_alive(self):
        """An object can still be made."""
        create = self.lib.simCreateDummy if IS_OLD else self.lib.simCreateDummy_D
        create.argtypes = [ctypes.c_float if IS_OLD else ctypes.c_double, POINTER]
        handle = create(0.01, None)
        return handle >= 0 and self.lib.simGetObjectType(handle) == 4


def call_all(library, integer, number):
    """The functions with parameters that have worked."""
    worked = set()
    library.last_error()
    for name, result, call in functions(library.lib):
        returned = call(*[value(kind, integer, number) for kind in call.argtypes])
        error = library.last_error()
        if error == "No error.":
            failed = result == "k" and returned != 1
            assert not failed, f"{name} fails without a reason"
            if call.argtypes:
                worked.add(name)
        elif name not in ("simSetLastError", "simGetLastError"):
            assert error.startswith(name + ": "), f"{name}: {error}"
            is_failure = returned in (None, -1, -1.0) or "Engine" in name
            assert is_failure, f"{name} returns {returned} and fails: {error}"
    return worked


def main():
    library = Library()
    library.start()
    for integer, number in [(0, 0.0), (-1, -1.0), (1, math.inf), (2**31 - 1, 1e300), (-(2**31), -math.inf)]:
        call_all(library, integer, number)
        assert library.is_alive(), library.last_error()
    worked = call_all(library, 987654, math.nan)
    assert worked <= TOLERANT, "these accept what means nothing: " + " ".join(sorted(worked - TOLERANT))
    stale = {name for name in TOLERANT if hasattr(library.lib, name)} - worked
    assert not stale, "these are refused now: " + " ".join(sorted(stale))
    assert library.is_alive(), library.last_error()
    library.end()
    print("ok")


main()
