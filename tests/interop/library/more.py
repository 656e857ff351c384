"""What programs for CoppeliaSim 4.1 and V-REP call beyond research stacks: names, stored data, scripts, the selection, paths, queries of
shapes and sensors, images.

Usage: more.py TABLE FOLDER, where TABLE has the declarations and FOLDER is for files.
"""

import math
import pathlib
import sys

import sim41

TABLE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
MAIN, CHILD, ADD_ON, CUSTOMIZATION, SANDBOX = 0, 1, 2, 6, 8
TRIANGLES = 2
BOTH_SIDES = 3
SINGLE = -8
EXECUTION_COUNT = 2


def near(values, expected, tolerance=1e-5):
    assert len(values) == len(expected), (list(values), expected)
    for value, other in zip(values, expected):
        assert abs(value - other) <= tolerance, (list(values), expected)


def fails(call, *args, text):
    try:
        call(*args)
    except sim41.Failed as failed:
        assert text in str(failed), failed
    else:
        raise AssertionError(f"accepted: {args}")


def cuboid(sim, at, size=0.1, options=8 | 16):
    handle = sim.CreatePureShape(0, options, [size, size, size], 1.0, None)
    sim.SetObjectPosition(handle, -1, at)
    return handle


def position(sim, handle):
    values = sim.floats(3)
    sim.GetObjectPosition(handle, -1, values)
    return list(values)


def run(sim, code):
    """The values of a text in the sandbox, as numbers."""
    stack = sim.CreateStack()
    sim.ExecuteScriptString(SANDBOX, code, stack)
    values = []
    for _ in range(sim.GetStackSize(stack)):
        value = sim.ffi.new("double[1]")
        sim.MoveStackItemToTop(stack, 0)
        values.append(value[0] if sim.GetStackDoubleValue(stack, value) == 1 else None)
    sim.ReleaseStack(stack)
    return values


def names(sim):
    """New objects have the names of V-REP; a second one of a kind gets a number."""
    volume, zeros = [0] * 8, [0.0] * 15
    created = {
        "Dummy": lambda: sim.CreateDummy(0.01, None),
        "Revolute_joint": lambda: sim.CreateJoint(10, 0, 0, [0.1, 0.02], None, None),
        "Prismatic_joint": lambda: sim.CreateJoint(11, 0, 0, [0.1, 0.02], None, None),
        "Spherical_joint": lambda: sim.CreateJoint(12, 0, 0, [0.1, 0.02], None, None),
        "Vision_sensor": lambda: sim.CreateVisionSensor(1, [8, 4, 0, 0], [0.1, 1.0, 0.5, 0.1] + zeros[:7], None),
        "Proximity_sensor": lambda: sim.CreateProximitySensor(34, 16, 0, [3, 3, 2, 2, 1, 1, 0, 0], [0.0, 1.0] + zeros[2:], None),
        "Force_sensor": lambda: sim.CreateForceSensor(0, [0, 1, 1, 0, 0], [0.05, 10.0, 10.0, 0.0, 0.0], None),
        "Cuboid": lambda: cuboid(sim, [0.0, 0.0, 5.0]),
        "Sphere": lambda: sim.CreatePureShape(1, 0, [0.1, 0.1, 0.1], 1.0, None),
        "Cylinder": lambda: sim.CreatePureShape(2, 0, [0.1, 0.1, 0.1], 1.0, None),
        "Shape": lambda: sim.CreateMeshShape(0, 0.3, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0], 9, [0, 1, 2], 3, None),
        "Octree": lambda: sim.CreateOctree(0.1, 0, 1.0, None),
        "Point_cloud": lambda: sim.CreatePointCloud(0.02, 20, 0, 2.0, None),
        "Path": lambda: sim.CreatePath(-1, None, None, None),
    }
    for name, create in created.items():
        first, second = create(), create()
        found = [sim.text(sim.GetObjectName(handle)) for handle in (first, second)]
        assert found == [name, name + "0"], found
        assert sim.GetObjectHandle(name) == first
        sim.RemoveObject(first), sim.RemoveObject(second)


def stored_data(sim):
    """Numbered blocks, whose length is asked for before there is room for them; lists of handles."""
    box, other = cuboid(sim, [0.0, 0.0, 5.0]), sim.CreateDummy(0.01, None)
    sim.AddSceneCustomData(77, "a\0b", 3)
    sim.AddObjectCustomData(box, 77, "xyz", 3)
    assert (sim.GetSceneCustomDataLength(77), sim.GetObjectCustomDataLength(box, 77)) == (3, 3)
    assert (sim.GetSceneCustomDataLength(78), sim.GetObjectCustomDataLength(other, 77)) == (0, 0)
    room = sim.ffi.new("char[4]", b"...!")
    sim.GetSceneCustomData(77, room)
    assert bytes(sim.ffi.buffer(room)) == b"a\0b!"
    sim.GetObjectCustomData(box, 77, room)
    assert bytes(sim.ffi.buffer(room)) == b"xyz!"
    fails(sim.GetObjectCustomDataLength, 987654, 77, text="does not exist")
    sim.SetReferencedHandles(box, 2, [other, box], None, None)
    handles = sim.pointer()
    assert sim.GetReferencedHandles(box, handles, None, None) == 2
    assert sim.list(handles[0], "int", 2) == [other, box]
    assert sim.GetReferencedHandles(other, handles, None, None) == 0
    assert sim.GetReferencedHandles(box, None, None, None) == 2


def tables(sim):
    """The places of the results of a call with four tables."""
    return [sim.pointer() if number % 2 == 0 else sim.integers(1) for number in range(8)]


def scripts(sim):
    """Scripts by place, what they are, their variables and functions; an add-on that a program has made is found by its name, and the
    text of its error is the last error."""
    run(sim, "made = sim.createScript(sim.scripttype_addon, [[sim = require 'sim' x = 1 function get() return {x} end function refuse() error('on purpose') end]])@")
    made = int(run(sim, "made@")[0])
    run(sim, "sim.setObjectAlias(made, 'Made') sim.initScript(made)@")
    assert run(sim, "sim.getScript(sim.scripttype_addon, 'Made') == made and 1 or 0@") == [1]
    handles, place = [], 0
    while (handle := sim.lib.simGetScript(place)) != -1:
        handles.append(handle)
        place += 1
    assert made in handles and len(set(handles)) == len(handles) > 2, handles
    kind, owner = sim.integers(1), sim.integers(1)
    sim.GetScriptProperty(made, kind, owner)
    assert (kind[0], owner[0]) == (ADD_ON, made)
    stack = sim.CreateStack()
    sim.PushInt32OntoStack(stack, 42)
    assert sim.SetScriptVariable(ADD_ON, "x@Made", stack) == 1
    sim.ReleaseStack(stack)
    number, integer = sim.floats(1), sim.integers(1)
    sim.SetScriptAttribute(made, EXECUTION_COUNT, 0.0, 17)
    sim.GetScriptAttribute(made, EXECUTION_COUNT, number, integer)
    assert (integer[0], number[0]) == (17, 0)
    places = tables(sim)
    nothing = (sim.ffi.NULL, 0) * 4
    assert sim.lib.simExtCallScriptFunction(ADD_ON, sim.argument("get@Made"), *nothing, *places) == 1, sim.last_error()
    assert sim.list(places[0][0], "int", 1) == [42]
    assert sim.lib.simExtCallScriptFunction(ADD_ON, sim.argument("refuse@Made"), *nothing, *places) == -1
    error = sim.last_error()
    assert error.startswith("simExtCallScriptFunction: refuse@Made: ") and "on purpose" in error and "traceback" not in error, error
    sim.ResetScript(made)
    stack = sim.CreateStack()
    assert sim.CallScriptFunctionEx(ADD_ON, "get@Made", stack) == 0
    assert sim.GetStackTableInfo(stack, 0) == 1
    sim.ReleaseStack(stack)
    fails(sim.GetScriptProperty, 987654, kind, owner, text="simGetScriptProperty")
    words = sim.text(sim.GetApiFunc(-1, "sim.getObjectPos")).split(" ")
    assert "sim.getObjectPosition" in words and all(word.startswith("sim.getObjectPos") for word in words), words
    assert sim.lib.simGetApiFunc(-1, sim.argument("sim.nothingOfThatName")) == sim.ffi.NULL


def the_selection(sim):
    box = cuboid(sim, [0.0, 0.0, 5.0])
    sim.AddObjectToSelection(SINGLE, box)
    sim.ScaleSelectedObjects(2.0, 1)
    size = sim.floats(3)
    sim.GetObjectSizeValues(box, size)
    assert sim.GetObjectSizeFactor(box) == 2 and position(sim, box)[2] == 10
    sim.CopyPasteSelectedObjects()
    copy = sim.GetObjectLastSelection()
    assert copy != box and sim.GetObjectSelectionSize() == 1
    near(position(sim, copy), [0, 0, 10])
    sim.DeleteSelectedObjects()
    assert sim.IsHandleValid(copy, -1) == 0 and sim.IsHandleValid(box, -1) == 1
    sim.RemoveObject(box)


def messages(sim):
    """Tubes, wireless messages; there are no messages of a user interface, and no dialogs."""
    ends = [sim.TubeOpen(7, "pipe", 0, 0) for _ in range(2)]
    assert sim.TubeWrite(ends[0], "a\0b", 3) == 1
    here, there, length = sim.integers(1), sim.integers(1), sim.integers(1)
    assert sim.TubeStatus(ends[1], here, there) == 1 and (here[0], there[0]) == (1, 0)
    data = sim.TubeRead(ends[1], length)
    assert sim.list(data, "char", length[0]) == [b"a", b"\0", b"b"]
    assert sim.TubeRead(ends[1], length) == sim.ffi.NULL and length[0] == 0
    assert sim.TubeClose(ends[0]) == 1
    sim.SendData(-2, 9, "news", "four", 4, -1, 1.0, 1.0, 1.0, 1.0)
    sender, header, name = sim.integers(1), sim.integers(1), sim.pointer()
    data = sim.ReceiveData(9, "news", -1, -1, length, sender, header, name)
    assert bytes(sim.ffi.buffer(sim.ffi.cast("char*", data), length[0])) == b"four" and header[0] == 9
    assert sim.text(name[0]) == "news" and sim.lib.simReleaseBuffer(data) == 1
    assert sim.ReceiveData(9, "news", -1, -1, length, sender, header, name) == sim.ffi.NULL
    message, numbers = sim.ffi.new("int[1]", [5]), sim.ffi.new("int[4]", [5] * 4)
    assert sim.GetSimulatorMessage(message, numbers, length) == sim.ffi.NULL
    assert (message[0], list(numbers), length[0]) == (-1, [0] * 4, 0)
    assert sim.lib.simDisplayDialog(sim.argument("title"), sim.argument("text"), 0, *[sim.ffi.NULL] * 4) == -1
    assert sim.MsgBox(0, 0, "title", "text") >= 0


def queries(sim):
    """Segments of an intersection, points of a program seen by a sensor, vertices and triangles of a shape."""
    boxes, segments = [cuboid(sim, [x, 0.0, 5.0]) for x in (0.0, 0.05)], sim.pointer()
    count = sim.CheckCollisionEx(*boxes, segments)
    values = sim.list(segments[0], "float", 6 * count)
    assert count > 0 and all(-0.05 < x < 0.1001 for x in values[0::3]), values
    assert sim.CheckCollisionEx(*boxes, None) == count
    numbers = [0.0] * 15
    numbers[1] = 1.0
    sensor = sim.CreateProximitySensor(34, 16, 0, [3, 3, 2, 2, 1, 1, 0, 0], numbers, None)
    triangle = [-1.0, -1.0, 0.5, 1.0, -1.0, 0.5, 0.0, 1.0, 0.5]
    point, normal = sim.floats(4), sim.floats(3)
    assert sim.CheckProximitySensorEx2(sensor, triangle, TRIANGLES, 1, BOTH_SIDES, 0.0, 0.0, point, normal) == 1, sim.last_error()
    near(point, [0, 0, 0.5, 0.5])
    near([abs(value) for value in normal], [0, 0, 1])
    assert sim.CheckProximitySensorEx2(sensor, triangle, TRIANGLES, 1, BOTH_SIDES, 0.4, 0.0, point, normal) == 0
    fails(sim.CheckProximitySensorEx2, sensor, triangle, 3, 1, 0, 0.0, 0.0, point, normal, text="no kind of items")
    mesh = sim.CreateMeshShape(0, 0.3, [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0], 9, [0, 1, 2], 3, None)
    place, corners, normals = sim.floats(3), sim.integers(3), sim.floats(9)
    vertices = []
    while sim.GetShapeVertex(mesh, 0, len(vertices), place) == 1:
        vertices.append(list(place))
    assert len(vertices) == 3 and sim.GetShapeVertex(mesh, 1, 0, place) == 0
    sides = sorted(math.dist(vertices[a], vertices[b]) for a, b in ((0, 1), (1, 2), (2, 0)))
    near(sides, [1, 2, math.sqrt(5)])
    assert sim.GetShapeTriangle(mesh, 0, 0, corners, normals) == 1 and sorted(corners) == [0, 1, 2]
    near([math.hypot(*normals[3 * n : 3 * n + 3]) for n in range(3)], [1] * 3)
    assert sim.GetShapeTriangle(mesh, 0, 1, corners, normals) == 0


def paths(sim):
    """Control points: floats, and among them integers as such."""
    path = sim.CreatePath(-1, None, None, None)
    points = sim.ffi.new("float[22]")
    points[11] = 2.0
    points[6] = points[17] = 1.0
    integers = sim.ffi.cast("int*", points)
    integers[8] = integers[19] = 1
    sim.InsertPathCtrlPoints(path, 0, 0, 2, points)
    length, data, flags = sim.floats(1), sim.floats(4), sim.integers(1)
    sim.GetPathLength(path, length)
    assert abs(length[0] - 2) < 1e-5, length[0]
    assert sim.GetDataOnPath(path, 0.5, 0, flags, data) == 1 and (flags[0], list(data)) == (0, [0] * 4)
    sim.CutPathCtrlPoints(path, -1, -1)
    fails(sim.GetPositionOnPath, path, 0.5, data, text="empty")
    fails(sim.InsertPathCtrlPoints, path, 0, 0, 2, None, text="NULL")


def motion_in_one_step(sim):
    """A velocity that is reached: acceleration 2 for half a second. Each call is a step from the state it gets."""
    doubles = lambda *numbers: sim.ffi.new("double[]", numbers)
    state, selection = doubles(0, 0, 0), sim.ffi.new("unsigned char[]", [1])
    steps = 0
    while sim.RMLVelocity(1, 0.05, -1, state, doubles(2, 1000), selection, doubles(1), state, None) == 0:
        steps += 1
    assert steps in (9, 10, 11) and abs(state[1] - 1) < 1e-6, (steps, list(state))
    state = doubles(0, 0, 0)
    assert sim.RMLPosition(1, 0.05, -1, state, doubles(1, 1, 1), selection, doubles(1, 0), state, None) == 0
    near(state, [0.05**3 / 6, 0.05**2 / 2, 0.05])
    fails(sim.RMLPosition, 1, 0.05, -1, None, doubles(1, 1, 1), selection, doubles(1, 0), state, None, text="NULL")


def images(sim):
    pixels = sim.ffi.new("unsigned char[]", [1, 2, 3, 4, 5, 6])
    sim.TransformImage(pixels, [2, 1], 2, None, None, None)
    assert list(pixels) == [4, 5, 6, 1, 2, 3]
    sides = sim.ffi.new("int[2]", [4, 2])
    scaled = sim.GetScaledImage(pixels, [2, 1], sides, 0, None)
    assert list(sides) == [4, 2]
    assert sim.list(scaled, "unsigned char", 24)[0:3] == [4, 5, 6]
    fails(sim.TransformImage, None, [2, 1], 2, None, None, None, text="NULL")
    points = sim.AddPointCloud(-1, -1, -1, 0, 2.0, 2, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], sim.argument("abc"), None, None)
    sim.RemoveDrawingObject(points)
    camera = sim.GetObjectHandle("DefaultCamera")
    before = position(sim, camera)
    assert sim.CameraFitToView(camera | 0x400000, 1, [cuboid(sim, [0.0, 0.0, 5.0])], 0, 1.0) == 1
    assert position(sim, camera) != before


def settings(sim):
    assert sim.DoesFileExist(TABLE) == 1
    assert [sim.DoesFileExist(path) for path in (str(FOLDER), "/none/of/that")] == [0, 0]
    sim.SetSimulationPassesPerRenderingPass(3)
    assert sim.GetSimulationPassesPerRenderingPass() == 3
    assert sim.IsRealTimeSimulationStepNeeded() == 0
    assert sim.GetModuleName(0, None) == sim.ffi.NULL
    fails(sim.GetPathPlanningHandle, "Task", text="simGetPathPlanningHandle")
    fails(sim.GetUIHandle, "UI", text="simGetUIHandle")


CHECKS = [names, stored_data, scripts, the_selection, messages, queries, paths, motion_in_one_step, images, settings]


def main():
    sim = sim41.Sim(*sim41.compiled(TABLE, FOLDER)).launch()
    for check in CHECKS:
        try:
            check(sim)
        except Exception as error:
            raise RuntimeError(f"{check.__name__}: {error}") from error
    sim.shut_down()
    print("ok")


main()
