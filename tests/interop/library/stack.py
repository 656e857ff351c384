"""What a research stack on CoppeliaSim 4.1 does with the library: an extension with all 608 functions, and those it calls.

Usage: stack.py TABLE FOLDER, where TABLE has the declarations and FOLDER is for files.
"""

import math
import pathlib
import struct
import sys
import time

import sim41

TABLE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
DYNAMIC, IK = 5, 2
CUBOID = 0
ADD_ON = 2


def near(values, expected, tolerance=1e-6):
    assert len(values) == len(expected), (values, expected)
    for value, other in zip(values, expected):
        assert abs(value - other) <= tolerance, (list(values), expected)


def fails(call, *args, text):
    try:
        call(*args)
    except sim41.Failed as failed:
        assert text in str(failed), failed
    else:
        raise AssertionError(f"accepted: {args}")


def position(sim, handle):
    values = sim.floats(3)
    sim.GetObjectPosition(handle, -1, values)
    return list(values)


def cuboid(sim, at, options=8 | 16, size=0.1):
    handle = sim.CreatePureShape(CUBOID, options, [size, size, size], 1.0, None)
    sim.SetObjectPosition(handle, -1, at)
    return handle


def before_the_launch(sim):
    """Calls before the start are errors that say what to do; the verbosity may be set."""
    assert sim.lib.simGetSimulationState() == -1
    assert "simExtLaunchUIThread" in sim.last_error()
    assert sim.lib.simExtCanInitSimThread() == 0
    sim.SetStringParameter(121, "scripterrors")


def objects(sim):
    box = cuboid(sim, [1.0, 2.0, 3.0])
    near(position(sim, box), [1, 2, 3])
    sim.SetObjectName(box, "Box")
    assert sim.text(sim.GetObjectName(box)) == "Box"
    assert sim.GetObjectHandle("Box") == box
    assert (sim.GetObjectType(box), sim.lib.simGetObjectParent(box)) == (0, -1)
    half = [0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4)]
    sim.SetObjectQuaternion(box, -1, half)
    angles, matrix = sim.floats(3), sim.floats(12)
    sim.GetObjectOrientation(box, -1, angles)
    near(angles, [0, 0, math.pi / 2])
    sim.GetObjectMatrix(box, -1, matrix)
    near(matrix, [0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3])
    product = sim.floats(12)
    inverse = sim.ffi.new("float[]", list(matrix))
    sim.InvertMatrix(inverse)
    sim.MultiplyMatrices(matrix, inverse, product)
    near(product, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0])
    child = sim.CreateDummy(0.01, None)
    sim.SetObjectParent(child, box, 1)
    count = sim.integers(1)
    tree = sim.list(sim.GetObjectsInTree(box, -2, 1, count), "int", 1)
    assert (tree, count[0]) == ([child], 1)
    copies = sim.ffi.new("int[]", [box])
    sim.CopyPasteObjects(copies, 1, 0)
    assert copies[0] not in (box, child) and sim.text(sim.GetObjectName(copies[0])) == "Box#0"
    sim.RemoveObject(child)
    fails(sim.RemoveObject, child, text="does not exist")
    fails(sim.GetObjectHandle, "Nobody", text="simGetObjectHandle: object does not exist")


def joints(sim):
    joint = sim.CreateJoint(10, DYNAMIC, 0, [0.1, 0.02], None, None)
    sim.SetJointInterval(joint, 0, [-1.0, 2.0])
    cyclic, interval, value = sim.ffi.new("unsigned char[1]", [9]), sim.floats(2), sim.floats(1)
    sim.GetJointInterval(joint, cyclic, interval)
    assert (cyclic[0], list(interval)) == (0, [-1, 2])
    for name, number in [("Position", 0.25), ("TargetPosition", 0.5), ("TargetVelocity", -0.75), ("MaxForce", 12.5)]:
        getattr(sim, f"SetJoint{name}")(joint, number)
        getattr(sim, f"GetJoint{name}")(joint, value)
        assert value[0] == number, (name, value[0])
    options = sim.integers(1)
    sim.SetJointMode(joint, IK, 0)
    assert (sim.GetJointMode(joint, options), sim.GetJointType(joint)) == (IK, 10)


def parameters_and_signals(sim):
    box, integer, number, wide = cuboid(sim, [0.0, 0.0, 1.0]), sim.integers(1), sim.floats(1), sim.ffi.new("double[1]")
    sim.SetObjectInt32Parameter(box, 3003, 0)
    assert (sim.GetObjectInt32Parameter(box, 3003, integer), integer[0]) == (1, 0)
    assert sim.GetObjectInt32Parameter(box, 99999, integer) == 0
    sim.SetObjectFloatParameter(box, 3005, 2.5)
    assert (sim.GetObjectFloatParameter(box, 3005, number), number[0]) == (1, 2.5)
    known = sim.ffi.new("unsigned char[1]")
    sim.SetEngineFloatParameter(6003, box, None, 0.5)
    assert (sim.GetEngineFloatParameter(6003, box, None, known), known[0]) == (0.5, 1)
    assert sim.lib.simGetEngineFloatParameter(123456, box, sim.ffi.NULL, known) == -1 and known[0] == 0
    for name, value, place in [("Integer", 7, integer), ("Float", 1.5, number), ("Double", 0.1, wide)]:
        get, clear = getattr(sim, f"Get{name}Signal"), getattr(sim, f"Clear{name}Signal")
        getattr(sim, f"Set{name}Signal")("signal", value)
        assert (get("signal", place), place[0]) == (1, value)
        clear("signal")
        assert get("signal", place) == 0
    sim.SetStringSignal("signal", "a\0b", 3)
    text = sim.GetStringSignal("signal", integer)
    assert (sim.list(text, "char", 3), integer[0]) == ([b"a", b"\0", b"b"], 3)
    sim.ClearStringSignal("signal")
    assert sim.lib.simGetStringSignal(sim.argument("signal"), integer) == sim.ffi.NULL
    sim.SetFloatParameter(1, 0.01)
    assert abs(sim.GetSimulationTimeStep() - 0.01) < 1e-7
    sim.SetFloatParameter(1, 0.05)
    assert sim.text(sim.GetStringParameter(0)) == sim41.ROOT


def pictures(sim):
    """A camera above a red box: colours from 0 to 1, depths from 0 to 1."""
    box = cuboid(sim, [5.0, 5.0, 0.05])
    sim.SetShapeColor(box, None, 0, [1.0, 0.0, 0.0])
    colour = sim.floats(3)
    assert sim.GetShapeColor(box, None, 0, colour) == 1 and list(colour) == [1, 0, 0]
    near_clip, far_clip = 0.5, 4.5
    settings = [near_clip, far_clip, 0.5, 0.1] + [0.0] * 7
    camera = sim.CreateVisionSensor(1 | 2, [8, 4, 0, 0], settings, None)
    sim.SetObjectPosition(camera, -1, [5.0, 5.0, 1.1])
    sim.SetObjectOrientation(camera, -1, [math.pi, 0.0, 0.0])
    values, counts, sides = sim.pointer(), sim.pointer(), sim.integers(2)
    assert sim.HandleVisionSensor(camera, values, counts) >= 0
    packets = sim.list(counts[0], "int", 2)
    assert packets[0] == 1 and len(sim.list(values[0], "float", packets[1])) == 15
    sim.GetVisionSensorResolution(camera, sides)
    assert list(sides) == [8, 4]
    image = sim.list(sim.GetVisionSensorImage(camera), "float", 8 * 4 * 3)
    middle = 3 * (8 * 2 + 4)
    assert image[middle] > 0.5 and max(image[middle + 1 : middle + 3]) < 0.1, image[middle : middle + 3]
    depths = sim.list(sim.GetVisionSensorDepthBuffer(camera), "float", 8 * 4)
    assert abs(near_clip + depths[8 * 2 + 4] * (far_clip - near_clip) - 1.0) < 2e-3
    sim.SetExplicitHandling(camera, 1)
    assert sim.GetExplicitHandling(camera) == 1


def sensors(sim):
    """A proximity sensor that looks along z at a box half a metre away."""
    box = cuboid(sim, [-5.0, 0.0, 0.55])
    numbers = [0.0] * 15
    numbers[1] = 1.0
    sensor = sim.CreateProximitySensor(34, 16, 0, [3, 3, 2, 2, 1, 1, 0, 0], numbers, None)
    sim.SetObjectPosition(sensor, -1, [-5.0, 0.0, 0.0])
    point = sim.floats(4)
    assert sim.CheckProximitySensor(sensor, box, point) == 1
    near(list(point)[2:], [0.5, 0.5], 1e-5)
    other, distance = cuboid(sim, [-5.0, 0.3, 0.55]), sim.floats(7)
    assert sim.CheckCollision(box, other) == 0
    assert sim.CheckDistance(box, other, 0.0, distance) == 1
    assert abs(distance[6] - 0.2) < 1e-5
    force = sim.CreateForceSensor(0, [0, 1, 1, 0, 0], [0.05, 10.0, 10.0, 0.0, 0.0], None)
    assert sim.lib.simReadForceSensor(force, sim.floats(3), sim.floats(3)) == 0


def shapes(sim):
    corners, indices = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0], [0, 1, 2]
    mesh = sim.CreateMeshShape(0, 0.3, corners, 9, indices, 3, None)
    vertices, found, triangles, normals = sim.pointer(), sim.integers(1), sim.pointer(), sim.pointer()
    found_indices = sim.integers(1)
    sim.GetShapeMesh(mesh, vertices, found, triangles, found_indices, normals)
    assert (found[0], found_indices[0]) == (9, 3)
    assert sim.list(triangles[0], "int", 3) == indices
    sim.list(vertices[0], "float", 9), sim.list(normals[0], "float", 9)
    pixels = sim.ffi.new("unsigned char[]", [255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 8, 7])
    texture = sim.ApplyTexture(mesh, [0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 6, pixels, [2, 2], 0)
    assert sim.GetShapeTextureId(mesh) == texture
    info = sim.ffi.new("char[120]")
    assert sim.GetShapeViz(mesh, 0, info) == 2
    fields = struct.unpack("<QixxxxQifQ9fxxxxQi2ixxxxQii", sim.ffi.buffer(info)[:])
    assert (fields[1], fields[3], fields[16], fields[17:19]) == (9, 3, texture, (2, 2))
    image = sim.list(sim.ffi.cast("void*", fields[15]), "unsigned char", 16)
    assert sorted(image[0::4]) == [0, 0, 9, 255] and set(image[3::4]) == {255}
    coordinates = sim.list(sim.ffi.cast("void*", fields[19]), "float", 6)
    assert coordinates == [0, 0, 1, 0, 0, 1]
    assert sim.GetShapeViz(mesh, 1, info) == 0
    plane_texture, sides = sim.integers(1), sim.ffi.new("int[]", [16, 8])
    sim.CreateTexture("", 0, None, None, None, 0, plane_texture, sides, None)
    box = cuboid(sim, [0.0, 0.0, 2.0])
    sim.SetShapeTexture(box, plane_texture[0], 0, 0, [1.0, 1.0], None, None)
    assert (sim.GetShapeTextureId(box), list(sides)) == (plane_texture[0], [16, 8])
    group = sim.GroupShapes([cuboid(sim, [0.0, 0.0, 3.0]), cuboid(sim, [0.0, 0.0, 4.0])], 2)
    parts = sim.integers(1)
    assert len(sim.list(sim.UngroupShape(group, parts), "int", 2)) == parts[0] == 2
    pieces = sim.ConvexDecompose(box, 0, [1, 500, 100], [100.0, 30.0, 0.25])
    assert sim.GetObjectType(pieces) == 0


def meshes_in_files(sim):
    path = str(FOLDER / "triangle.obj")
    vertices = sim.ffi.new("float[]", [0, 0, 0, 1, 0, 0, 0, 1, 0])
    indices = sim.ffi.new("int[]", [0, 1, 2])
    lists = sim.ffi.new("float*[]", [vertices]), sim.ffi.new("int*[]", [indices])
    sim.ExportMesh(0, path, 0, 1.0, 1, lists[0], [9], lists[1], [3], None, None)
    places = [sim.pointer() for _ in range(6)]
    assert sim.ImportMesh(0, path, 0, 0.0, 2.0, *places) == 1
    sizes = sim.list(places[1][0], "int", 1)
    addresses = sim.list(places[0][0], "void*", 1)
    assert sizes == [9]
    assert sorted(sim.list(addresses[0], "float", 9)) == [0] * 7 + [2, 2]
    fails(sim.ImportMesh, 0, str(FOLDER / "none.obj"), 0, 0.0, 1.0, *places, text="file does not exist")
    assert sim.GetObjectType(sim.ImportShape(0, path, 0, 0.0001, 1.0)) == 0


def octrees(sim):
    octree = sim.CreateOctree(0.1, 0, 1.0, None)
    points, count = [0.05, 0.05, 0.05, 1.05, 0.05, 0.05], sim.integers(1)
    assert sim.InsertVoxelsIntoOctree(octree, 0, points, 2, None, None, None) == 2
    address = sim.GetOctreeVoxels(octree, count, None)
    voxels = list(sim.ffi.cast("float*", address)[0:6])
    assert count[0] == 2
    near(sorted(voxels), [0.05] * 5 + [1.05])
    tag, place = sim.integers(1), sim.ffi.new("unsigned long long[1]")
    assert sim.CheckOctreePointOccupancy(octree, 0, points, 1, tag, place, None) == 1
    assert sim.CheckOctreePointOccupancy(octree, 0, [3.0, 3.0, 3.0], 1, tag, place, None) == 0
    box = cuboid(sim, [1.05, 0.05, 0.05], size=0.09)
    assert sim.InsertObjectIntoOctree(octree, box, 0, None, 5, None) == 2
    assert sim.SubtractObjectFromOctree(octree, box, 0, None) == 1
    assert sim.RemoveVoxelsFromOctree(octree, 0, None, 0, None) == 0


def configuration_trees(sim):
    """Poses and joints of a tree go back to what they were."""
    joint, box, value = sim.CreateJoint(10, 0, 0, [0.1, 0.02], None, None), cuboid(sim, [0.5, 0.0, 0.0]), sim.floats(1)
    sim.SetObjectParent(box, joint, 1)
    configuration = sim.GetConfigurationTree(joint)
    sim.SetJointPosition(joint, 1.0)
    sim.SetObjectPosition(box, joint, [0.0, 0.0, 9.0])
    sim.SetConfigurationTree(configuration)
    sim.GetJointPosition(joint, value)
    assert value[0] == 0
    near(position(sim, box), [0.5, 0, 0])
    assert sim.lib.simReleaseBuffer(configuration) == 1
    fails(sim.SetConfigurationTree, sim.ffi.new("char[16]"), text="no configuration")
    fails(sim.SetConfigurationTree, None, text="NULL")


def kinematics(sim):
    """A planar arm of two links of half a metre, whose joints have motors: a group as files of V-REP have it, solved without moving them."""
    arm, parent = [], -1
    for x in (0.0, 0.5):
        joint = sim.CreateJoint(10, DYNAMIC, 0, [0.1, 0.02], None, None)
        sim.SetObjectParent(joint, parent, 1)
        sim.SetObjectPosition(joint, parent, [x, 0.0, 0.0])
        arm.append(joint)
        parent = joint
    tip, target = sim.CreateDummy(0.01, None), sim.CreateDummy(0.01, None)
    sim.SetObjectParent(tip, parent, 1)
    sim.SetObjectPosition(tip, parent, [0.5, 0.0, 0.0])
    sim.SetJointPosition(arm[0], 0.3)
    sim.SetJointPosition(arm[1], 0.6)
    sim.SetLinkDummy(tip, target)
    group = sim.CreateIkGroup(0, [0, 50], None, None)
    sim.CreateIkElement(group, 0, [tip, -1, -1, 1 | 2], None, None)
    goal = (0.5 * (math.cos(0.5) + math.cos(1.3)), 0.5 * (math.sin(0.5) + math.sin(1.3)))
    sim.SetObjectPosition(target, -1, [goal[0], goal[1], 0.0])
    values = sim.floats(2)
    result = sim.CheckIkGroup(group, 2, arm, values, None)
    assert result == 1, (result, list(values), sim.last_error())
    near(values, [0.5, 0.8], 1e-4)
    found = sim.floats(2)
    assert sim.GetConfigForTipPose(group, 2, arm, 0.65, 100, found, None, 0, None, None, None, None, None) == 1
    elbow = [0.5 * (math.cos(found[0]) + math.cos(sum(found))), 0.5 * (math.sin(found[0]) + math.sin(sum(found)))]
    near(elbow, goal, 1e-3)
    path = sim.list(sim.GenerateIkPath(group, 2, arm, 5, 0, None, None, None), "float", 10)
    near(path[:2] + path[-2:], [0.3, 0.6, 0.5, 0.8], 1e-3)
    for joint, before in zip(arm, (0.3, 0.6)):
        sim.GetJointPosition(joint, values)
        assert abs(values[0] - before) < 1e-6


def motion_profiles(sim):
    doubles = lambda *numbers: sim.ffi.new("double[]", numbers)
    selection = sim.ffi.new("unsigned char[]", [1])
    handle = sim.RMLPos(1, 0.0001, -1, doubles(0, 0, 0), doubles(1, 1, 1), selection, doubles(1, 0), None)
    state, steps = doubles(0, 0, 0), 0
    while sim.RMLStep(handle, 0.05, state, None, None) == 0:
        steps += 1
    # Jerk 1 all the way: four thirds of a second times the cube root of 32.
    assert abs(steps * 0.05 - 32 ** (1 / 3)) < 0.1 and abs(state[0] - 1) < 1e-6, (steps, list(state))
    sim.RMLRemove(handle)
    fails(sim.RMLStep, handle, 0.05, state, None, None, text="simRMLStep")


def four_tables(sim):
    """The add-on `Stack` in the folder of the library gets integers, floats, texts and bytes, and returns such lists."""
    texts = [sim.ffi.new("char[]", text) for text in (b"one", b"two")]
    places = [sim.pointer() if number % 2 == 0 else sim.integers(1) for number in range(8)]
    name = sim.argument("twice@Stack")
    strings = sim.ffi.new("char*[]", texts)
    data = sim.ffi.new("char[]", b"\1\0\2")
    result = sim.lib.simExtCallScriptFunction(
        ADD_ON, name, sim.ffi.new("int[]", [1, 2]), 2, sim.ffi.new("float[]", [0.5]), 1, strings, 2, data, 3, *places
    )
    assert result == 1, sim.last_error()
    counts = [place[0] for place in places[1::2]]
    assert counts == [2, 1, 2, 3]
    assert sim.list(places[0][0], "int", 2) == [2, 4]
    assert sim.list(places[2][0], "float", 1) == [1.0]
    addresses = sim.ffi.cast("char**", places[4][0])
    assert [sim.ffi.string(addresses[number]) for number in range(2)] == [b"oneone", b"twotwo"]
    assert sim.lib.simReleaseBuffer(places[4][0]) == 1
    assert sim.list(places[6][0], "char", 3) == [b"\1", b"\0", b"\2"]
    nobody = sim.argument("none@Stack")
    rest = (sim.ffi.NULL, 0) * 4
    assert sim.lib.simExtCallScriptFunction(ADD_ON, nobody, *rest, *places) == -1
    assert "none" in sim.last_error()


def planning(sim):
    """The add-on plans with simOMPL and simVision as globals; a path comes back as floats."""
    places = [sim.pointer() if number % 2 == 0 else sim.integers(1) for number in range(8)]
    args = (sim.ffi.new("int[]", [cuboid(sim, [9.0, 9.0, 0.0])]), 1) + (sim.ffi.NULL, 0) * 3
    result = sim.lib.simExtCallScriptFunction(ADD_ON, sim.argument("plan@Stack"), *args, *places)
    assert result == 1, sim.last_error()
    path = sim.list(places[2][0], "float", places[3][0])
    near(path[:2] + path[-2:], [-1, 0, 1, 0], 1e-3)


def simulation(sim):
    """A box falls onto the floor and rests there; contacts have points and forces."""
    box = cuboid(sim, [2.0, -2.0, 0.3], options=8)
    time, places, numbers = sim.GetSimulationTime(), sim.integers(2), sim.floats(9)
    sim.StartSimulation()
    sim.step(40)
    assert sim.GetSimulationTime() > time + 1.9
    assert abs(position(sim, box)[2] - 0.05) < 2e-3
    assert sim.GetContactInfo(-2, box, 0, places, numbers) == 1 and box in list(places)
    assert sim.GetContactInfo(-2, box, 0 | 4194304, places, numbers) == 1
    assert abs(abs(numbers[8]) - 1) < 1e-3, list(numbers)
    linear, angular = sim.floats(3), sim.floats(3)
    sim.GetObjectVelocity(box, linear, angular)
    near(linear, [0, 0, 0], 1e-3)
    sim.AddForceAndTorque(box, [0.0, 0.0, 30.0], [0.0, 0.0, 0.0])
    sim.step()
    assert position(sim, box)[2] > 0.055
    sim.stop()
    near(position(sim, box), [2, -2, 0.3])


def files(sim):
    path = FOLDER / "box.ttm"
    box = cuboid(sim, [0.0, 1.0, 0.0])
    sim.SetModelProperty(box, 0)
    sim.SaveModel(box, str(path))
    loaded = sim.LoadModel(str(path))
    near(position(sim, loaded), position(sim, box))
    sim.RemoveModel(loaded)
    sim.SaveScene(str(FOLDER / "scene.ttt"))
    assert (FOLDER / "scene.ttt").stat().st_size > 1000


def drawings(sim):
    drawing = sim.AddDrawingObject(1, 0.1, 0.0, -1, 10, [1.0, 0.0, 0.0], None, None, None)
    assert sim.AddDrawingObjectItem(drawing, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]) == 1
    sim.AddDrawingObjectItem(drawing, None)
    sim.RemoveDrawingObject(drawing)


def missing(sim):
    """What is not there says so; wrong lists and counts are errors."""
    fails(sim.HandleMill, 1, sim.floats(2), text="simHandleMill: it is not implemented in Swanilda")
    fails(sim.GetObjectPosition, 987654, -1, sim.floats(3), text="does not exist")
    fails(sim.SetObjectPosition, sim.CreateDummy(0.01, None), -1, None, text="simSetObjectPosition")
    fails(sim.GroupShapes, None, 3, text="NULL")
    fails(sim.CheckIkGroup, 1, -1, None, sim.floats(1), None, text="-1 is no number")
    fails(sim.LoadModel, None, text="simLoadModel")
    assert sim.lib.simReleaseBuffer(sim.ffi.new("char[4]")) == -1


CHECKS = [
    objects,
    joints,
    parameters_and_signals,
    pictures,
    sensors,
    shapes,
    meshes_in_files,
    octrees,
    configuration_trees,
    kinematics,
    motion_profiles,
    four_tables,
    planning,
    simulation,
    files,
    drawings,
    missing,
]


def main():
    sim = sim41.Sim(*sim41.compiled(TABLE, FOLDER))
    before_the_launch(sim)
    for launch in ("first", "again"):
        sim.launch()
        for check in CHECKS:
            began = time.monotonic()
            try:
                check(sim)
            except Exception as error:
                raise RuntimeError(f"{launch}: {check.__name__}: {error}") from error
            if "-v" in sys.argv:
                print(launch, check.__name__, round(time.monotonic() - began, 3))
        sim.shut_down()
    print("ok")


main()
