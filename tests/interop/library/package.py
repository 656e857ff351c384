"""What CoppeliaSim's own Python package does with the library of 4.10, by ctypes: one thread starts and loops, functions are called
by name with stacks, modules describe themselves, types come from calltips.

Usage: package.py TABLE FOLDER, which are not used.
"""

import ctypes
import importlib
import os
import sys
import threading
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_longlong, c_void_p

ROOT = os.environ["COPPELIASIM_ROOT"]
STRING_PARAM_PYTHON_FOLDER = 137
VIEW_FRUSTUM = 1019

lib = ctypes.cdll.LoadLibrary(ROOT + "/libcoppeliaSimHeadless.so")
for name in ("simGetStackStringValue", "simGetStringParam", "simGetLastError"):
    getattr(lib, name).restype = c_void_p
lib.simReleaseBuffer.argtypes = [c_void_p]
lib.simPushDoubleOntoStack.argtypes = [c_int, c_double]
lib.simPushInt64OntoStack.argtypes = [c_int, c_longlong]
lib.simPushBoolOntoStack.argtypes = [c_int, c_bool]
lib.simRunGui.restype = None


def text_of(address, length=None):
    text = ctypes.string_at(address) if length is None else ctypes.string_at(address, length)
    lib.simReleaseBuffer(address)
    return text


def push(stack, value):
    if value is None:
        lib.simPushNullOntoStack(stack)
    elif isinstance(value, bool):
        lib.simPushBoolOntoStack(stack, value)
    elif isinstance(value, int):
        lib.simPushInt64OntoStack(stack, value)
    elif isinstance(value, float):
        lib.simPushDoubleOntoStack(stack, value)
    elif isinstance(value, (str, bytes)):
        data = value.encode() if isinstance(value, str) else value
        lib.simPushStringOntoStack(stack, c_char_p(data), len(data))
    else:
        lib.simPushTableOntoStack(stack)
        items = value.items() if isinstance(value, dict) else enumerate(value, 1)
        for key, item in items:
            push(stack, key)
            push(stack, item)
            lib.simInsertDataIntoStackTable(stack)


def pop(stack):
    """The value on top, which is taken off."""
    kind = lib.simGetStackItemType(stack, -1)
    if kind == 4:
        return pop_table(stack)
    value = None
    if kind == 1:
        number = c_double()
        lib.simGetStackDoubleValue(stack, byref(number))
        value = number.value
    elif kind == 2:
        flag = c_bool()
        lib.simGetStackBoolValue(stack, byref(flag))
        value = flag.value
    elif kind == 3:
        length = c_int()
        address = lib.simGetStackStringValue(stack, byref(length))
        value = text_of(address, length.value).decode()
    elif kind == 9:
        number = c_longlong()
        lib.simGetStackInt64Value(stack, byref(number))
        value = number.value
    lib.simPopStackItem(stack, 1)
    return value


def pop_table(stack):
    count = lib.simGetStackTableInfo(stack, 0)
    below = lib.simGetStackSize(stack) - 1
    lib.simUnfoldStackTable(stack)
    entries = {}
    while lib.simGetStackSize(stack) > below:
        value = pop(stack)
        entries[pop(stack)] = value
    if count >= 0 and sorted(map(str, entries)) == sorted(str(key) for key in range(1, len(entries) + 1)):
        return [entries[key] for key in range(1, len(entries) + 1)]
    return entries


def call(function, *args):
    """The results of a function of scripts."""
    stack = lib.simCreateStack()
    for arg in args:
        push(stack, arg)
    result = lib.simCallScriptFunctionEx(-1, (function + "@lua").encode(), stack)
    if result == -1:
        error = text_of(lib.simGetLastError()).decode()
        lib.simReleaseStack(stack)
        raise RuntimeError(error)
    results = []
    while lib.simGetStackSize(stack) > 0:
        results.insert(0, pop(stack))
    lib.simReleaseStack(stack)
    return results


def functions_by_name():
    handle = call("sim.createDummy", 0.1)[0]
    call("sim.setObjectPosition", handle, [1.0, 2.0, 3.0])
    assert call("sim.getObjectPosition", handle) == [[1.0, 2.0, 3.0]]
    assert call("sim.getObjectAlias", handle) == ["dummy"] or call("sim.getObjectAlias", handle) == ["Dummy"]
    try:
        call("sim.getObjectPosition", 987654)
    except RuntimeError as error:
        assert "does not exist" in str(error), error
    else:
        raise AssertionError("an object that is not there has a position")


def modules():
    """`require` of the bridge; a module as functions and constants."""
    call("require", "scriptClientBridge")
    call("scriptClientBridge.require", "simIK")
    described = call("scriptClientBridge.info", "simIK")[0]
    assert described["createEnvironment"] == {"func": []} or described["createEnvironment"] == {"func": {}}, described["createEnvironment"]
    sim = call("scriptClientBridge.info", "sim")[0]
    assert sim["handle_world"] == {"const": -1} and "func" in sim["getObject"]
    assert call("scriptClientBridge.getField", "sim.handle_all") == [-2]


def types_of_functions():
    folder = text_of(lib.simGetStringParam(STRING_PARAM_PYTHON_FOLDER)).decode()
    sys.path.append(folder)
    calltip = importlib.import_module("calltip")
    line = call("sim.getApiInfo", -1, "sim.getObject")[0].split("\n")[0]
    function = calltip.FuncDef.from_calltip(line)
    assert [variable.type for variable in function.in_args] == ["string", "map"], line
    assert [(variable.name, variable.type) for variable in function.out_args] == [("objectHandle", "int")]
    line = call("sim.getApiInfo", -1, "simIK.createEnvironment")[0].split("\n")[0]
    assert calltip.FuncDef.from_calltip(line).func_name == "simIK.createEnvironment", line
    assert call("sim.getApiInfo", -1, "sim.nothing") == [""]
    assert "sim.getObject" in call("sim.getApiFunc", -1, "sim.getObj")[0]


def lists_of_doubles():
    """Functions of plugins whose lists have double precision: voxels, terrain, drawings, meshes in files."""
    doubles = lambda *numbers: (c_double * len(numbers))(*numbers)
    lib.simCreateOctree_D.argtypes = [c_double, c_int, c_double, c_void_p]
    lib.simGetOctreeVoxels_D.restype = ctypes.POINTER(c_double)
    octree, count = lib.simCreateOctree_D(0.1, 0, 1.0, None), c_int()
    assert lib.simInsertVoxelsIntoOctree_D(octree, 0, doubles(0.05, 0.05, 1.05), 1, None, None, None) == 1
    voxels = lib.simGetOctreeVoxels_D(octree, byref(count), None)
    assert count.value == 1 and all(abs(a - b) < 1e-12 for a, b in zip(voxels[0:3], (0.05, 0.05, 1.05))), voxels[0:3]
    lib.simCreateHeightfieldShape_D.argtypes = [c_int, c_double, c_int, c_int, c_double, c_void_p]
    terrain = lib.simCreateHeightfieldShape_D(0, 0.0, 2, 2, 1.0, doubles(0, 0, 0, 0.5))
    assert call("sim.getObjectType", terrain) == [0]
    lib.simAddDrawingObject_D.argtypes = [c_int, c_double, c_double] + [c_int] * 2 + [c_void_p] * 4
    drawing = lib.simAddDrawingObject_D(0, 1.0, 0.0, -1, 10, None, None, None, None)
    assert lib.simAddDrawingObjectItem_D(drawing, doubles(1, 2, 3)) == 1
    lib.simRemoveDrawingObject(drawing)
    lib.simSetSimulationTimeStep_D(c_double(0.1))
    assert abs(call("sim.getSimulationTimeStep")[0] - 0.1) < 1e-12
    lib.simSetSimulationTimeStep_D(c_double(0.05))


def newer_functions():
    """Functions of plugins for 4.10: poses on stacks, handles and tables as properties, named references, shapes and images."""
    doubles = lambda *numbers: (c_double * len(numbers))(*numbers)
    dummy, other = call("sim.createDummy", 0.1)[0], call("sim.createDummy", 0.1)[0]
    stack, pose, read = lib.simCreateStack(), doubles(1, 2, 3, 0, 0, 0, 1), doubles(*[0] * 7)
    assert lib.simPushPoseOntoStack(stack, pose) == 1 and lib.simPushPoseOntoStack(stack, None) == -1
    assert lib.simGetStackPose(stack, read) == 1 and list(read) == list(pose)
    assert lib.simGetStackQuaternion(stack, read) == 0
    lib.simReleaseStack(stack)
    target, number, size = c_longlong(dummy), c_longlong(), c_int()
    assert lib.simSetHandleProperty(target, b"customData.handle", c_longlong(other)) == 1
    assert lib.simGetHandleProperty(target, b"customData.handle", byref(number)) == 1 and number.value == other
    handles = ctypes.POINTER(c_longlong)()
    assert lib.simSetHandleArrayProperty(target, b"customData.handles", (c_longlong * 2)(other, dummy), 2) == 1
    assert lib.simGetHandleArrayProperty2(target, b"customData.handles", byref(handles), byref(size)) == 1
    assert handles[0 : size.value] == [other, dummy]
    lib.simReleaseBuffer(handles)
    call("sim.setTableProperty", dummy, "customData.table", {"a": 1, "b": [2, 3]})
    lib.simGetTableProperty.restype = c_void_p
    packed = text_of(lib.simGetTableProperty(target, b"customData.table", byref(size)), size.value)
    assert lib.simSetTableProperty(target, b"customData.copy", packed, len(packed)) == 1
    assert call("sim.getTableProperty", dummy, "customData.copy") == [{"a": 1, "b": [2, 3]}]
    found = ctypes.POINTER(c_int)()
    assert lib.simSetReferencedHandles(dummy, 1, (c_int * 1)(other), b"tag", None) == 1
    assert lib.simGetReferencedHandles(dummy, byref(found), b"tag", None) == 1 and found[0] == other
    lib.simReleaseBuffer(found)
    assert lib.simGetReferencedHandles(dummy, None, None, None) == 0


def shapes_and_images():
    doubles = lambda *numbers: (c_double * len(numbers))(*numbers)
    corners, indices = doubles(0, 0, 0, 1, 0, 0, 0, 1, 0), (c_int * 3)(0, 1, 2)
    coordinates, pixels = (ctypes.c_float * 6)(0, 0, 1, 0, 0, 1), (ctypes.c_ubyte * 12)(*range(12))
    plain = lib.simCreateShape(0, c_double(0.3), corners, 9, indices, 3, None, None, None, None)
    textured = lib.simCreateShape(0, c_double(0.3), corners, 9, indices, 3, None, coordinates, pixels, (c_int * 2)(2, 2))
    assert [call("sim.getObjectType", shape) for shape in (plain, textured)] == [[0], [0]], text_of(lib.simGetLastError())
    assert (lib.simGetShapeTextureId(plain), lib.simGetShapeTextureId(textured) >= 0) == (-1, True)
    camera = call("sim.createVisionSensor", 1, [2, 1, 0, 0], [0.1, 1.0, 0.5, 0.1] + [0.0] * 7)[0]
    image, sides = (ctypes.c_ubyte * 6)(1, 2, 3, 4, 5, 6), (c_int * 2)()
    assert lib.simSetVisionSensorImg(camera, image, 0, None, None) == 1
    assert lib.simSetVisionSensorImg(camera, image, 0, (c_int * 2)(1, 0), (c_int * 2)(1, 1)) == 1
    assert lib.simSetVisionSensorImg(camera, None, 0, None, None) == -1
    lib.simGetVisionSensorImg_D.restype = c_void_p
    seen = text_of(lib.simGetVisionSensorImg_D(camera, 0, c_double(0), None, None, sides), 6)
    assert (seen, list(sides)) == (bytes([1, 2, 3, 1, 2, 3]), [2, 1])
    size = c_int()
    lib.simGetObjectFloatArrayParam_D.restype = ctypes.POINTER(c_double)
    frustum = lib.simGetObjectFloatArrayParam_D(camera, VIEW_FRUSTUM, byref(size))
    assert size.value == 6 and abs(frustum[2] - 0.1) < 1e-6, frustum[0 : size.value]


def motion_and_hooks():
    doubles = lambda *numbers: (c_double * len(numbers))(*numbers)
    state, left, steps = doubles(0, 0, 0), c_double(), 0
    selection, limits = (ctypes.c_ubyte * 1)(1), doubles(1, 1, 1)
    motion = lib.simRuckigPos(1, c_double(0.0001), -1, state, limits, selection, doubles(1, 0), None, None)
    while lib.simRuckigStep(motion, c_double(0.05), state, byref(left), None, None) == 0:
        steps += 1
    # Jerk 1 all the way.
    assert abs(steps * 0.05 - 32 ** (1 / 3)) < 0.1 and abs(state[0] - 1) < 1e-6, (steps, list(state))
    assert lib.simRuckigRemove(motion) == 1 and lib.simRuckigStep(motion, c_double(0.05), state, None, None, None) == -1
    assert lib.simExecuteScriptString(-1, b"count = 0 function hooked() count = count + 1 end", 0) == 0
    assert lib.simRegisterScriptFuncHook(-1, b"sysCall_nonSimulation", b"hooked", 1, 0) == 1, text_of(lib.simGetLastError())
    for _ in range(3):
        lib.simLoop(None, 0)
    stack, count = lib.simCreateStack(), c_double()
    assert lib.simExecuteScriptString(-1, b"count", stack) == 0
    assert lib.simGetStackDoubleValue(stack, byref(count)) == 1 and count.value == 3, count.value
    lib.simReleaseStack(stack)


def simulation(calls):
    call("sim.startSimulation")
    for _ in range(10):
        lib.simLoop(None, 1)
    time = call("sim.getSimulationTime")[0]
    assert abs(time - 0.5) < 1e-9, time
    call("sim.stopSimulation")
    callback = ctypes.CFUNCTYPE(None)(lambda: calls.append(1))
    for _ in range(6):
        lib.simLoop(callback, 1)
    assert call("sim.getSimulationState") == [0] and len(calls) == 6


def session(failures):
    try:
        assert lib.simInitialize(ROOT.encode(), 0) == 1, text_of(lib.simGetLastError())
        for check in (functions_by_name, modules, types_of_functions, lists_of_doubles, newer_functions, shapes_and_images, motion_and_hooks, lambda: simulation([])):
            check()
        assert lib.simGetExitRequest() == 0
        call("sim.quitSimulator")
        lib.simLoop(None, 0)
        assert lib.simGetExitRequest() == 1
        lib.simDeinitialize()
    except BaseException as error:
        failures.append(error)
        lib.simDeinitialize()


def main():
    failures = []
    # As with --true-headless: one thread does all.
    session(failures)
    assert not failures, failures
    # Else the main thread waits for the end.
    thread = threading.Thread(target=session, args=(failures,))
    thread.start()
    lib.simRunGui(0)
    thread.join(60)
    assert not failures and not thread.is_alive(), failures
    print("ok")


main()
