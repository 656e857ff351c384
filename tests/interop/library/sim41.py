"""The library of CoppeliaSim 4.1 as research programs use it: an extension compiled by cffi in API mode, linked with -lcoppeliaSim.

`COPPELIASIM_ROOT` is the folder of the library. The declarations have the types of the ABI: int, unsigned char, unsigned long long,
float, double, addresses.
"""

import importlib.util
import os
import pathlib
import threading
import time

ROOT = os.environ["COPPELIASIM_ROOT"]
TYPES = {
    "i": "int",
    "b": "unsigned char",
    "l": "unsigned long long",
    "f": "float",
    "d": "double",
    "p": "void*",
    "v": "void",
}


def declarations(table):
    """C declarations of every function in the table: name, result, parameters by letter."""
    lines = []
    for line in pathlib.Path(table).read_text().splitlines():
        name, result, params = line.split("\t")
        types = ", ".join(TYPES[letter] for letter in params) or "void"
        lines.append(f"{TYPES[result]} {name}({types});")
    return "\n".join(lines)


def compiled(table, folder):
    """The extension, linked with the library and compiled once: Python loads it with all symbols resolved."""
    files = list(pathlib.Path(folder).glob("_sim41*.so"))
    path = files[0] if files else compile_extension(table, folder)
    spec = importlib.util.spec_from_file_location("_sim41", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.ffi, module.lib


def compile_extension(table, folder):
    import cffi

    ffi = cffi.FFI()
    text = declarations(table)
    ffi.cdef(text)
    ffi.set_source(
        "_sim41",
        text,
        libraries=["coppeliaSim"],
        library_dirs=[ROOT],
        extra_link_args=[f"-Wl,-rpath,{ROOT}"],
    )
    return ffi.compile(tmpdir=str(folder))


class Failed(Exception):
    """A function returned -1; the text is the simulator's."""


class Sim:
    """The simulator of a process: one thread waits in the launch, the calling one steps."""

    def __init__(self, ffi, lib):
        self.ffi, self.lib = ffi, lib

    def __getattr__(self, name):
        """`sim.GetObjectHandle(...)`: texts become bytes, lists floats or integers, None NULL; -1 raises."""
        function = getattr(self.lib, "sim" + name)

        def call(*args):
            result = function(*[self.argument(arg) for arg in args])
            if isinstance(result, int) and result == -1:
                raise Failed(self.last_error())
            return result

        return call

    def argument(self, arg):
        if arg is None:
            return self.ffi.NULL
        if isinstance(arg, str):
            return self.ffi.from_buffer(arg.encode() + b"\0")
        if isinstance(arg, list):
            kind = "float[]" if any(isinstance(item, float) for item in arg) else "int[]"
            return self.ffi.new(kind, arg)
        return arg

    def floats(self, count):
        return self.ffi.new("float[]", count)

    def integers(self, count):
        return self.ffi.new("int[]", count)

    def pointer(self):
        return self.ffi.new("void*[1]")

    def text(self, address):
        """A text that the caller releases."""
        assert address != self.ffi.NULL, self.last_error()
        text = self.ffi.string(self.ffi.cast("char*", address)).decode()
        assert self.lib.simReleaseBuffer(address) == 1
        return text

    def list(self, address, kind, count):
        """A list that the caller releases."""
        assert address != self.ffi.NULL, self.last_error()
        values = list(self.ffi.cast(f"{kind}*", address)[0:count])
        assert self.lib.simReleaseBuffer(address) == 1
        return values

    def last_error(self):
        return self.text(self.lib.simGetLastError())

    def launch(self, scene=""):
        options = 0

        def wait():
            cwd = os.getcwd()
            os.chdir(ROOT)
            name = self.ffi.from_buffer(b"Test\0")
            path = self.ffi.from_buffer(scene.encode() + b"\0")
            root = self.ffi.from_buffer(ROOT.encode() + b"\0")
            self.launched = self.lib.simExtLaunchUIThread(name, options, path, root)
            os.chdir(cwd)

        self.thread = threading.Thread(target=wait, daemon=True)
        self.thread.start()
        until = time.monotonic() + 60
        while not self.lib.simExtCanInitSimThread():
            assert time.monotonic() < until, "the library does not start"
            time.sleep(0.01)
        self.ExtSimThreadInit()
        self.ExtStep(0)
        return self

    def step(self, count=1):
        for _ in range(count):
            self.ExtStep(1)

    def stop(self):
        self.StopSimulation()
        until = time.monotonic() + 60
        while self.GetSimulationState() != 0:
            assert time.monotonic() < until, "the simulation does not stop"
            self.ExtStep(1)

    def shut_down(self):
        self.ExtPostExitRequest()
        assert self.ExtGetExitRequest() == 1
        self.ExtSimThreadDestroy()
        self.thread.join(60)
        assert not self.thread.is_alive(), "the launch does not return"
