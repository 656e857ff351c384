"""A CycloneDDS client drives every service and the action of the standard simulation interfaces (`swanilda serve --ros2`)."""

import math
import pathlib
import re
import tempfile

from ros2_types import LATCHED, ActionClient, Client, make, message, nodes, reader, samples, until
from simulator import Simulator

STOPPED, PLAYING, PAUSED, QUITTING, NO_WORLD = range(5)
UNSUPPORTED, OK, NOT_FOUND, INCORRECT_STATE, FAILED = range(5)
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
ALL = (
    "GetSimulatorFeatures GetSimulationState SetSimulationState StepSimulation ResetSimulation GetEntities GetEntitiesStates GetEntityState "
    "SetEntityState GetEntityInfo SetEntityInfo GetEntityBounds DeleteEntity GetNamedPoses GetNamedPoseBounds SpawnEntity SpawnEntities "
    "GetSpawnables LoadWorld UnloadWorld GetCurrentWorld GetAvailableWorlds"
).split()
URDF = (
    '<?xml version="1.0"?><robot name="brick"><link name="base"><inertial><mass value="2"/>'
    '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>'
    '<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link></robot>'
)
SDF = f'<?xml version="1.0"?><sdf version="1.7"><world name="w">{{}}</world></sdf>'


def snake_case(name):
    return re.sub(r"(?<=[a-z])([A-Z])", r"_\1", name).lower()


def of(name):
    return message(f"simulation_interfaces/msg/{name}")


def geometry(name, **fields):
    return make(message(f"geometry_msgs/msg/{name}"), **fields)


def pose(x, y, z, **quaternion):
    quaternion = quaternion or {"w": 1.0}
    return geometry("Pose", position=geometry("Point", x=x, y=y, z=z), orientation=geometry("Quaternion", **quaternion))


def stamped(x, y, z, frame="world"):
    header = make(message("std_msgs/msg/Header"), frame_id=frame)
    return geometry("PoseStamped", header=header, pose=pose(x, y, z))


def resource(uri="", text=""):
    return make(of("Resource"), uri=uri, resource_string=text)


def state(number):
    return make(of("SimulationState"), state=number)


def filters(**fields):
    return make(of("EntityFilters"), **fields)


CALLS = {name: Client(snake_case(name), f"simulation_interfaces/srv/{name}") for name in ALL}
PARAMETERS = "GetParameters GetParameterTypes SetParameters SetParametersAtomically DescribeParameters ListParameters".split()
STEPS = ActionClient("simulate_steps", "simulation_interfaces/action/SimulateSteps")
NODES = nodes()
LOG = reader("rt/rosout", message("rcl_interfaces/msg/Log"), LATCHED)
CLOCK = reader("rt/clock", message("rosgraph_msgs/msg/Clock"))


def call(service, /, **fields):
    return CALLS[service](**fields)


def good(service, /, **fields):
    reply = call(service, **fields)
    assert (reply.result.result, reply.result.error_message) == (OK, ""), (service, reply)
    return reply


def bad(service, code, words, /, **fields):
    result = call(service, **fields).result
    assert result.result == code and words in result.error_message, (service, result)


def now():
    return call("GetSimulationState").state.state


def to(number):
    good("SetSimulationState", state=state(number))
    assert now() == number


def entity(name):
    return good("GetEntityState", entity=name).state


def time_of(name):
    stamp = entity(name).header.stamp
    return round(stamp.sec + stamp.nanosec * 1e-9, 6)


def names(**fields):
    return sorted(good("GetEntities", filters=filters(**fields)).entities)


def features():
    got = call("GetSimulatorFeatures").features
    assert {0, 5, 10, 20, 24, 31, 33, 40, 50} <= set(got.features) and 42 not in got.features
    assert set(got.spawn_formats) == {"urdf", "sdf", "mjcf", "ttm"}
    assert "Swanilda" in got.custom_info


def graph():
    """The node with the readers and writers of services, with those of parameters, of the action, /clock, /joint_states and /rosout."""
    readers, writers = until("the node", lambda: NODES().get("/sim_ros2_interface"))
    assert (readers, writers) == (len(ALL) + 3 + len(PARAMETERS), len(ALL) + 3 + len(PARAMETERS) + 2 + 3), (readers, writers)


def log():
    line = until("a line of the log", lambda: samples(LOG))[0]
    assert (line.level, line.name, line.msg) == (30, "sim_ros2_interface", "the arm is there"), line


def parameters():
    """Other nodes list, read and set what scripts have set."""
    of_node = {name: Client(f"sim_ros2_interface/{snake_case(name)}", f"rcl_interfaces/srv/{name}") for name in PARAMETERS}
    value, parameter = message("rcl_interfaces/msg/ParameterValue"), message("rcl_interfaces/msg/Parameter")

    def with_value(name, kind, **fields):
        return make(parameter, name=name, value=make(value, type=kind, **fields))

    listed = of_node["ListParameters"]().result
    assert (sorted(listed.names), listed.prefixes) == (["arm.gain", "arm.name", "debug"], ["arm"]), listed
    assert of_node["ListParameters"](prefixes=["arm"], depth=1).result.names == ["arm.gain", "arm.name"]
    assert of_node["ListParameters"](depth=1).result.names == ["debug"]
    got = of_node["GetParameters"](names=["arm.gain", "arm.name", "debug", "none"]).values
    assert [(one.type, one.double_value, one.string_value, one.bool_value) for one in got] == [
        (3, 2.5, "", False), (4, 0, "left", False), (1, 0, "", True), (0, 0, "", False)
    ], got  # fmt: skip
    assert list(of_node["GetParameterTypes"](names=["debug", "arm.gain"]).types) == [1, 3]
    described = of_node["DescribeParameters"](names=["arm.name"]).descriptors
    assert [(one.name, one.type) for one in described] == [("arm.name", 4)]
    wanted = [with_value("arm.gain", 3, double_value=4.0), with_value("arm.gain", 2, integer_value=4), with_value("new", 1), with_value("debug", 9)]
    results = of_node["SetParameters"](parameters=wanted).results
    assert [one.successful for one in results] == [True, False, False, False], results
    assert "another type" in results[1].reason and "not set by a script" in results[2].reason and "needs" in results[3].reason, results
    result = of_node["SetParametersAtomically"](parameters=[with_value("arm.gain", 3, double_value=8.0), with_value("new", 1)]).result
    assert not result.successful
    assert of_node["GetParameters"](names=["arm.gain"]).values[0].double_value == 4.0, "all or none"


def states():
    assert now() == STOPPED
    bad("SetSimulationState", 101, "stopped already", state=state(STOPPED))
    bad("SetSimulationState", 103, "load_world", state=state(NO_WORLD))
    bad("StepSimulation", FAILED, "while the simulation is paused; it is stopped", steps=1)
    to(PAUSED)
    assert time_of("Ball") == 0
    assert CALLS["GetSimulationState"].is_silent() and time_of("Ball") == 0, "no step and no tick while it is paused"
    to(PLAYING)
    until("some steps", lambda: time_of("Ball") > 0.2)
    to(PAUSED)
    before = time_of("Ball")
    assert CALLS["GetSimulationState"].is_silent() and time_of("Ball") == before
    to(STOPPED)


def steps():
    to(PAUSED)
    samples(CLOCK)
    good("StepSimulation", steps=1)
    assert time_of("Ball") == 0.05 and now() == PAUSED
    good("StepSimulation", steps=9)
    assert time_of("Ball") == 0.5
    ticks = [round(sample.clock.sec + sample.clock.nanosec * 1e-9, 6) for sample in until("the clock", lambda: samples(CLOCK))]
    assert ticks == sorted(set(ticks)) and len(ticks) <= 10, ticks
    fallen = 4.0 - entity("Ball").pose.position.z
    assert abs(fallen - 9.81 / 2 * 0.5**2) < 0.13, fallen
    assert STEPS.send(steps=4).accepted
    got = STEPS.result()
    assert (got.status, got.result.result.result) == (SUCCEEDED, OK), got
    feedback = [(one.feedback.completed_steps, one.feedback.remaining_steps) for one in samples(STEPS.feedback)]
    assert feedback == [(1, 3), (2, 2), (3, 1), (4, 0)], feedback
    assert time_of("Ball") == 0.7
    assert STEPS.send(steps=100_000_000).accepted
    until("feedback", lambda: samples(STEPS.feedback))
    assert STEPS.cancel().return_code == 0
    got = STEPS.result()
    assert got.status == CANCELED and now() == PAUSED, got
    to(PLAYING)
    assert STEPS.send(steps=3).accepted
    got = STEPS.result()
    assert got.status == ABORTED and "it is playing" in got.result.result.error_message, got
    to(STOPPED)


def entities():
    assert names() == ["Ball", "Floor", "Wall"], names()
    assert names(filter="^.a") == ["Ball", "Wall"]
    bad("GetEntities", FAILED, "no regular expression", filters=filters(filter="("))
    categories = {name: good("GetEntityInfo", entity=name).info.category.category for name in ("Ball", "Wall")}
    assert categories == {"Ball": 4, "Wall": 5}, categories
    info = make(of("EntityInfo"), category=make(of("EntityCategory"), category=2), description="a person", tags=["soft", "red"])
    good("SetEntityInfo", entity="Wall", info=info)
    assert good("GetEntityInfo", entity="Wall").info == info
    assert names(categories=[make(of("EntityCategory"), category=2)]) == ["Wall"]
    some, both = (make(of("TagsFilter"), tags=["red", "blue"], filter_mode=mode) for mode in (0, 1))
    assert names(tags=some) == ["Wall"] and names(tags=both) == []
    box = make(of("Bounds"), type=1, points=[geometry("Vector3", x=1.5, y=-9.0, z=0.0), geometry("Vector3", x=3.0, y=9.0, z=1.0)])
    assert "Wall" in names(bounds=box) and "Ball" not in names(bounds=box)
    sphere = make(of("Bounds"), type=3, points=[geometry("Vector3", z=4.0), geometry("Vector3", x=0.3)])
    assert names(bounds=sphere) == ["Ball"]
    corners = [(p.x, p.y, p.z) for p in good("GetEntityBounds", entity="Wall").bounds.points]
    assert all(math.isclose(a, b, abs_tol=1e-6) for a, b in zip(sum(corners, ()), (-0.05, -0.5, -0.25, 0.05, 0.5, 0.25))), corners
    for service in ("GetEntityState", "GetEntityInfo", "GetEntityBounds", "DeleteEntity"):
        bad(service, NOT_FOUND, "there is no entity 'Nobody'", entity="Nobody")
    many = good("GetEntitiesStates", filters=filters(filter="Ball"))
    assert many.entities == ["Ball"] and abs(many.states[0].pose.position.z - 4) < 1e-9


def set_states():
    wanted = make(of("EntityState"), pose=pose(0.5, 0.0, 3.0))
    good("SetEntityState", entity="Ball", state=wanted, set_pose=True)
    assert abs(entity("Ball").pose.position.z - 3) < 1e-9
    flat = make(of("EntityState"), pose=pose(0.0, 0.0, 0.0, w=0.5))
    bad("SetEntityState", 101, "no unit quaternion", entity="Ball", state=flat, set_pose=True)
    lost = make(of("EntityState"), pose=pose(0.0, 0.0, math.nan))
    bad("SetEntityState", 101, "not finite", entity="Ball", state=lost, set_pose=True)
    bad("SetEntityState", FAILED, "static", entity="Wall", state=wanted, set_twist=True)
    bad("SetEntityState", UNSUPPORTED, "forces", entity="Ball", state=wanted, set_acceleration=True)
    to(PAUSED)
    good("StepSimulation", steps=4)
    moving = make(of("EntityState"), pose=pose(0.0, 0.0, 5.0), twist=geometry("Twist", linear=geometry("Vector3", x=2.0)))
    good("SetEntityState", entity="Ball", state=moving, set_pose=True, set_twist=True)
    good("StepSimulation", steps=10)
    after = entity("Ball")
    assert abs(after.pose.position.x - 1) < 0.02 and abs(after.twist.linear.x - 2) < 0.02, after
    assert abs(after.twist.linear.z + 9.81 * 0.5) < 0.3, after
    to(STOPPED)


def resets():
    to(PAUSED)
    good("StepSimulation", steps=10)
    good("SpawnEntity", name="brick", entity_resource=resource(text=URDF), initial_pose=stamped(0.0, 3.0, 1.0))
    bad("ResetSimulation", UNSUPPORTED, "together with the state", scope=1)
    before = time_of("Ball")
    good("ResetSimulation", scope=2)
    assert time_of("Ball") == before and "brick" in names()
    height = entity("Ball").pose.position.z
    good("StepSimulation", steps=1)
    assert abs(entity("Ball").pose.position.z - height) < 0.02, "it begins at rest"
    good("ResetSimulation", scope=4)
    assert "brick" not in names() and time_of("Ball") > before
    good("ResetSimulation", scope=0)
    assert time_of("Ball") == 0 and now() == PAUSED
    to(STOPPED)


def spawns(folder):
    reply = good("SpawnEntity", name="", allow_renaming=True, entity_resource=resource(text=URDF), entity_namespace="r1", initial_pose=stamped(0.0, 2.0, 0.5))
    assert reply.entity_name == "brick"
    assert abs(entity("brick").pose.position.y - 2) < 1e-6
    same = {"entity_resource": resource(text=URDF), "initial_pose": stamped(0.0, 0.0, 1.0, frame="brick")}
    bad("SpawnEntity", 101, "already", name="brick", **same)
    bad("SpawnEntity", 102, "a name is needed", **same)
    bad("SpawnEntity", 102, "no name", name="a/b", **same)
    bad("SpawnEntity", 105, "namespace", name="b", entity_namespace="1//x", **same)
    bad("SpawnEntity", 104, "needed", name="b", initial_pose=stamped(0.0, 0.0, 1.0))
    bad("SpawnEntity", 103, "urdf", name="b", entity_resource=resource(uri="file:///tmp/x.obj"), initial_pose=stamped(0.0, 0.0, 1.0))
    bad("SpawnEntity", 103, "neither", name="b", entity_resource=resource(text="hello"), initial_pose=stamped(0.0, 0.0, 1.0))
    bad("SpawnEntity", 106, "", name="b", entity_resource=resource(text="<?xml version='1.0'?><robot name='x'><link"), initial_pose=stamped(0.0, 0.0, 1.0))
    bad("SpawnEntity", 109, "neither 'world' nor an entity", name="b", entity_resource=resource(text=URDF), initial_pose=stamped(0.0, 0.0, 1.0, frame="mars"))
    assert good("SpawnEntity", name="brick", allow_renaming=True, **same).entity_name == "brick_1"
    assert abs(entity("brick_1").pose.position.y - 2) < 1e-6, "a pose in the frame of an entity"
    (folder / "brick.urdf").write_text(URDF)
    one = make(of("SpawnEntity"), name="third", entity_resource=resource(uri=f"file://{folder}/brick.urdf"), initial_pose=stamped(4.0, 0.0, 1.0))
    reply = call("SpawnEntities", spawn_requests=[one, one])
    assert reply.result.result == 150 and [each.result.result for each in reply.results] == [OK, 101], reply
    found = good("GetSpawnables", sources=[f"file://{folder}"]).spawnables
    assert f"file://{folder}/brick.urdf" in [one.entity_resource.uri for one in found]
    bad("GetSpawnables", FAILED, "/nowhere", sources=["/nowhere"])
    for name in ("brick", "brick_1", "third"):
        good("DeleteEntity", entity=name)
    assert names() == ["Ball", "Floor", "Wall"]


def named_poses():
    poses = good("GetNamedPoses").poses
    assert [(one.name, one.pose.position.x) for one in poses] == [("Dock", 7.0)], poses
    assert good("GetNamedPoseBounds", name="Dock").bounds.type == 0
    bad("GetNamedPoseBounds", NOT_FOUND, "named pose", name="Ball")


def worlds(folder):
    current = good("GetCurrentWorld").world
    assert current.name == "ros2_interfaces_scene" and current.world_resource.uri.endswith("ros2_interfaces_scene.lua"), current
    model = SDF.format(
        "<model name='box'><pose>1 2 3 0 0 0</pose><static>true</static><link name='l'><collision name='c'>"
        "<geometry><box><size>1 1 1</size></box></geometry></collision></link></model>"
    )
    world = good("LoadWorld", world_resource=resource(text=model)).world
    assert world.name == "world" and names() == ["box"], (world, names())
    bad("LoadWorld", 101, ".ttt", world_resource=resource(uri="file:///tmp/x.obj"))
    bad("LoadWorld", 102, "needed")
    bad("LoadWorld", 103, "", world_resource=resource(uri="/nowhere/scene.ttt"))
    (folder / "w.world").write_text(model)
    listed = good("GetAvailableWorlds", additional_sources=[str(folder)]).worlds
    assert (f"file://{folder}/w.world", "w") in [(one.world_resource.uri, one.name) for one in listed], listed
    bad("GetAvailableWorlds", FAILED, "/nowhere", additional_sources=["/nowhere"])
    good("GetAvailableWorlds", additional_sources=["/nowhere"], continue_on_error=True)
    good("UnloadWorld")
    assert now() == NO_WORLD
    bad("UnloadWorld", 101, "no world")
    bad("GetCurrentWorld", 101, "no world")
    bad("SetSimulationState", INCORRECT_STATE, "load one first", state=state(PLAYING))
    good("LoadWorld", world_resource=resource(uri="tests/interop/ros2_interfaces_scene.lua"))
    assert now() == STOPPED and "Ball" in names()


def quits(simulator):
    good("SetSimulationState", state=state(QUITTING))
    until("the end of the program", lambda: simulator.process.poll() is not None)


with tempfile.TemporaryDirectory() as name, Simulator("tests/interop/ros2_interfaces_scene.lua", "--empty", "--ros2", "--no-remote-api") as simulator:
    folder = pathlib.Path(name)
    features()
    graph()
    log()
    parameters()
    states()
    steps()
    entities()
    set_states()
    resets()
    spawns(folder)
    named_poses()
    worlds(folder)
    quits(simulator)
