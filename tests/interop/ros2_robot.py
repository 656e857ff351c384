"""Robots of ROS 2 by a URDF (`swanilda serve robot.urdf --ros2`): CycloneDDS drives one with wheels and moves an arm, and compares what both publish."""

import array
import math
import pathlib
import shutil
import tempfile

from ros2_types import LATCHED, ActionClient, Client, make, message, reader, samples, until, writer
from simulator import ROOT, Simulator

ROVER = "scenes/ros2_rover.urdf"
OPTIONS = "--ros2", "--no-remote-api", "--dt", "0.05"
PAUSED, STOPPED = 2, 0
STEP = 0.05
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
OPTICAL = (-0.5, 0.5, -0.5, 0.5)

SET_STATE = Client("set_simulation_state", "simulation_interfaces/srv/SetSimulationState")
STEPS = Client("step_simulation", "simulation_interfaces/srv/StepSimulation")
SPAWN = Client("spawn_entity", "simulation_interfaces/srv/SpawnEntity")
ENTITY = Client("get_entity_state", "simulation_interfaces/srv/GetEntityState")
TWIST = message("geometry_msgs/msg/Twist")


def to(number):
    reply = SET_STATE(state=make(message("simulation_interfaces/msg/SimulationState"), state=number))
    assert reply.result.result == 1, reply


def steps(count):
    reply = STEPS(steps=count)
    assert reply.result.result == 1, reply


def geometry(name, **fields):
    return make(message(f"geometry_msgs/msg/{name}"), **fields)


def spawn(name, text="", uri="", at=(0.0, 0.0, 0.0), namespace=""):
    resource = make(message("simulation_interfaces/msg/Resource"), resource_string=text, uri=uri)
    pose = geometry("Pose", position=geometry("Point", x=at[0], y=at[1], z=at[2]), orientation=geometry("Quaternion", w=1.0))
    reply = SPAWN(name=name, entity_resource=resource, entity_namespace=namespace, initial_pose=geometry("PoseStamped", pose=pose))
    assert reply.result.result == 1, reply


def box(name, size, at, color):
    """A box that stays where it is."""
    spawn(name, f"""<?xml version="1.0"?><robot name="{name}"><link name="l"><visual><geometry><box size="{size}"/></geometry>
        <material name="m"><color rgba="{color} 1"/></material></visual></link></robot>""", at=at)  # fmt: skip


def topic(name, kind, qos=None):
    return reader(f"rt/{name}", message(kind), **({"qos": qos} if qos else {}))


def newest(of, what):
    """The next sample after those that came before."""
    samples(of)
    got = []

    def ask():
        steps(1)
        got.extend(samples(of))
        return got

    return until(what, ask)[-1]


def near(a, b, tolerance, what):
    assert abs(a - b) <= tolerance, (what, a, b)


def yaw(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def transforms(of):
    return {one.child_frame_id: one for sample in of for one in sample.transforms}


# ---------------------------------------------------------------- a robot with wheels


class Rover:
    def __init__(self, prefix=""):
        self.odometry = topic(f"{prefix}odom", "nav_msgs/msg/Odometry")
        self.states = topic(f"{prefix}joint_states", "sensor_msgs/msg/JointState")
        self.scan = topic(f"{prefix}scan", "sensor_msgs/msg/LaserScan")
        self.scan_points = topic(f"{prefix}scan/points", "sensor_msgs/msg/PointCloud2")
        self.image = topic(f"{prefix}camera/image", "sensor_msgs/msg/Image")
        self.compressed = topic(f"{prefix}camera/image/compressed", "sensor_msgs/msg/CompressedImage")
        self.info = topic(f"{prefix}camera/camera_info", "sensor_msgs/msg/CameraInfo")
        self.depth = topic(f"{prefix}camera/depth_image", "sensor_msgs/msg/Image")
        self.points = topic(f"{prefix}camera/points", "sensor_msgs/msg/PointCloud2")
        self.imu = topic(f"{prefix}imu", "sensor_msgs/msg/Imu")
        self.tf = topic(f"{prefix}tf", "tf2_msgs/msg/TFMessage")
        self.fixed = topic(f"{prefix}tf_static", "tf2_msgs/msg/TFMessage", LATCHED)
        self.description = topic(f"{prefix}robot_description", "std_msgs/msg/String", LATCHED)
        self.command = writer(f"rt/{prefix}cmd_vel", TWIST)
        self.stamped = writer(f"rt/{prefix}cmd_vel", message("geometry_msgs/msg/TwistStamped"))

    def drive(self, linear, angular, seconds):
        twist = geometry("Twist", linear=geometry("Vector3", x=linear), angular=geometry("Vector3", z=angular))
        until("a subscription", self.command.get_matched_subscriptions)
        self.command.write(twist)
        # The first command has come when the robot moves; then it is repeated before it is too old.
        until("motion", lambda: steps(1) or self.command.write(twist) or any(abs(one.twist.twist.linear.x - linear) < 0.1 for one in samples(self.odometry)))
        for _ in range(round(seconds / 0.2)):
            self.command.write(twist)
            steps(4)


def frames(rover):
    fixed = transforms(until("frames that do not move", lambda: samples(rover.fixed)))
    optical = fixed["camera_optical_frame"]
    q = optical.transform.rotation
    assert optical.header.frame_id == "camera_link" and all(abs(a - b) < 1e-9 for a, b in zip((q.x, q.y, q.z, q.w), OPTICAL)), optical
    lidar = fixed["lidar_link"]
    assert (lidar.header.frame_id, lidar.transform.translation.x, lidar.transform.translation.z) == ("base_link", 0.1, 0.15), lidar
    moving = transforms(until("frames", lambda: steps(1) or samples(rover.tf)))
    wheel = moving["left_wheel"]
    assert wheel.header.frame_id == "base_link" and abs(wheel.transform.translation.y - 0.15) < 1e-9, wheel
    assert moving["odom" if "odom" in moving else "base_link"].header.frame_id == "odom", moving
    assert not any("respondable" in name for name in moving), list(moving)
    assert until("the description", lambda: samples(rover.description))[0].data == (ROOT / ROVER).read_text()


def scan(rover):
    got = newest(rover.scan, "a scan")
    assert (got.header.frame_id, len(got.ranges)) == ("lidar_link", 360), got
    near(got.angle_min, -math.pi, 1e-4, "the first angle")
    seen = {"ahead": 0, "left": 0, "nothing": 0}
    for i, measured in enumerate(got.ranges):
        angle = got.angle_min + i * got.angle_increment
        if abs(angle) < 0.4:
            near(measured, (1.95 - 0.1) / math.cos(angle), 0.02, ("the wall ahead", angle))
            seen["ahead"] += 1
        elif abs(angle - math.pi / 2) < 0.4:
            near(measured, 1.45 / math.cos(angle - math.pi / 2), 0.02, ("the wall to the left", angle))
            seen["left"] += 1
        elif abs(angle) > 2.75 or abs(angle + math.pi / 2) < 0.4:
            assert measured == math.inf, ("nothing is there", angle, measured)
            seen["nothing"] += 1
    assert min(seen.values()) > 20, seen
    cloud = newest(rover.scan_points, "points of the lidar")
    points = floats(cloud.data, 3)
    assert cloud.header.frame_id == "lidar_link" and len(points) == cloud.width > 60
    ahead = [x for x, y, z in points if abs(y) < 0.5 and x > 0]
    assert ahead and all(abs(x - 1.85) < 0.02 for x in ahead), ahead[:5]
    assert max(y for _, y, _ in points) < 1.5 and min(y for _, y, _ in points) > -2.1


def floats(data, count):
    values = array.array("f", bytes(data))
    return [tuple(values[i : i + count]) for i in range(0, len(values), count)]


def camera(rover):
    image, info, depth, points = (newest(one, "a picture") for one in (rover.image, rover.info, rover.depth, rover.points))
    assert (image.encoding, image.width, image.height, image.step) == ("rgb8", 160, 120, 480)
    assert {one.header.frame_id for one in (image, info, depth, points)} == {"camera_optical_frame"}
    compressed = newest(rover.compressed, "a compressed picture")
    assert bytes(compressed.data[:2]) == b"\xff\xd8" and compressed.header.frame_id == "camera_optical_frame", compressed.format
    focal = 80 / math.tan(0.6)
    near(info.k[0], focal, 1e-9, "the focal length")
    assert (info.k[4], info.k[2], info.k[5], info.p[0]) == (info.k[0], 79.5, 59.5, info.k[0]), info.k

    def color(column, row):
        at = row * 480 + column * 3
        return tuple(image.data[at : at + 3])

    def is_mostly(channel, pixel):
        return all(pixel[channel] > 2 * pixel[other] for other in range(3) if other != channel)

    assert is_mostly(0, color(120, 60)), ("the wall is red", color(120, 60))
    # The post is 1.2 m ahead, 0.3 m to the left, and lower than the camera.
    ahead, left, below = 1.15 - 0.21, 0.3, 0.12
    column, row = round(79.5 - left / ahead * focal), round(59.5 + below / ahead * focal)
    assert is_mostly(1, color(column, row)), ("the post is green", color(column, row), column, row)
    assert is_mostly(0, color(column, 119 - row)) and is_mostly(0, color(159 - column, 119 - row))
    depths = [value for (value,) in floats(depth.data, 1)]
    near(depths[60 * 160 + 120], 1.95 - 0.21, 0.01, "the depth of the wall")
    near(depths[row * 160 + column], ahead, 0.01, "the depth of the post")
    assert depth.encoding == "32FC1" and depth.step == 640
    assert (points.width, points.height, points.point_step) == (160, 120, 16)
    assert [(one.name, one.offset) for one in points.fields] == [("x", 0), ("y", 4), ("z", 8), ("rgb", 12)]
    x, y, z, _ = floats(points.data, 4)[row * 160 + column]
    near(x, -left, 0.01, "x is to the right")
    near(y, below, 0.01, "y is down")
    near(z, ahead, 0.01, "z is ahead")
    at = (row * 160 + column) * 16 + 12
    blue, green, red = points.data[at : at + 3]
    assert (red, green, blue) == color(column, row)


def rest(rover):
    imu = newest(rover.imu, "an IMU")
    assert imu.header.frame_id == "base_link"
    near(imu.linear_acceleration.z, 9.81, 0.2, "what holds it up")
    near(imu.linear_acceleration.x, 0, 0.1, "no acceleration at rest")
    near(imu.angular_velocity.z, 0, 0.01, "no rotation at rest")


def place():
    return ENTITY(entity="base_link_respondable").state.pose


def drives(rover):
    before = place()
    start = newest(rover.odometry, "odometry").pose.pose
    near(start.position.x, 0, 0.01, "it begins at the origin")
    rover.drive(0.4, 0.5, 3)
    odometry = newest(rover.odometry, "odometry")
    assert (odometry.header.frame_id, odometry.child_frame_id) == ("odom", "base_link")
    near(odometry.twist.twist.linear.x, 0.4, 0.03, "speed")
    near(odometry.twist.twist.angular.z, 0.5, 0.05, "rotation")
    pose, true = odometry.pose.pose, place()
    turned = yaw(true.orientation) - yaw(before.orientation)
    assert turned > 1, ("it turns to the left", turned)
    near(yaw(pose.orientation), turned, 0.12, "heading")
    # The shape's place in base_link is where it was at first.
    offset = before.position.x, before.position.y
    x = true.position.x - offset[0] * math.cos(turned) + offset[1] * math.sin(turned)
    y = true.position.y - offset[0] * math.sin(turned) - offset[1] * math.cos(turned)
    assert math.hypot(x, y) > 0.8, (x, y)
    near(pose.position.x, x, 0.1, "where it is")
    near(pose.position.y, y, 0.1, "where it is")
    joints = newest(rover.states, "joints")
    speeds = dict(zip(joints.name, joints.velocity))
    assert set(speeds) == {"left_wheel_joint", "right_wheel_joint"}, speeds
    near(speeds["left_wheel_joint"], (0.4 - 0.5 * 0.15) / 0.1, 0.1, "left wheel")
    near(speeds["right_wheel_joint"], (0.4 + 0.5 * 0.15) / 0.1, 0.1, "right wheel")


def turns(rover):
    """On a circle the IMU feels the acceleration to its middle, which is to the left."""
    samples(rover.imu)
    rover.drive(0.4, 0.5, 2)
    felt = samples(rover.imu)[-20:]
    mean = [sum(values) / len(felt) for values in zip(*((one.angular_velocity.z, one.linear_acceleration.y, one.linear_acceleration.z) for one in felt))]
    near(mean[0], 0.5, 0.05, "rotation")
    near(mean[1], 0.2, 0.08, "acceleration to the left")
    near(mean[2], 9.81, 0.3, "what holds it up")


def stops(rover):
    """Half a second of the simulation after the last command the robot stands still."""
    rover.drive(0.4, 0.0, 0.6)
    samples(rover.odometry)
    steps(4)
    moving = until("odometry", lambda: samples(rover.odometry))[-1]
    near(moving.twist.twist.linear.x, 0.4, 0.05, "the command is not too old")
    steps(12)
    near(newest(rover.odometry, "odometry").twist.twist.linear.x, 0, 0.02, "the command is too old")


def stamped(rover):
    twist = geometry("TwistStamped", twist=geometry("Twist", linear=geometry("Vector3", x=-0.3)))
    until("a subscription", rover.stamped.get_matched_subscriptions)

    def backwards():
        rover.stamped.write(twist)
        steps(2)
        return any(one.twist.twist.linear.x < -0.25 for one in samples(rover.odometry))

    until("driving backwards", backwards)


def rates(rover):
    """Of 40 steps of 0.05 s a sensor with 10 pictures per second sees 20, with times of the simulation."""
    samples(rover.scan)
    got = []
    steps(40)
    until("scans", lambda: got.extend(samples(rover.scan)) or len(got) >= 20)
    stamps = [one.header.stamp.sec + one.header.stamp.nanosec * 1e-9 for one in got]
    assert len(got) == 20 and all(abs(b - a - 0.1) < 1e-6 for a, b in zip(stamps, stamps[1:])), stamps


def reset(rover):
    to(STOPPED)
    to(PAUSED)
    pose = newest(rover.odometry, "odometry").pose.pose
    near(pose.position.x, 0, 0.02, "odometry begins anew")
    near(yaw(pose.orientation), 0, 0.02, "odometry begins anew")


def rovers():
    with Simulator(ROVER, *OPTIONS) as simulator:
        simulator.line(lambda line: "/camera/points" in str(line) and "robot" in str(line), "the topics of the robot")
        box("wall", "0.1 4 1", (2.0, 0.0, 0.5), "0.9 0.05 0.05")
        box("side", "6 0.1 1", (0.0, 1.5, 0.5), "0.05 0.05 0.9")
        box("post", "0.1 0.1 0.1", (1.2, 0.3, 0.1), "0.05 0.9 0.05")
        rover = Rover()
        to(PAUSED)
        steps(10)
        for check in (frames, scan, camera, rest, drives, turns, stops, stamped, rates, reset):
            check(rover)


# ---------------------------------------------------------------- an arm


ARM = "tests/interop/ros2_arm.urdf"
GOAL = message("trajectory_msgs/msg/JointTrajectory")
POINT = message("trajectory_msgs/msg/JointTrajectoryPoint")
FORWARD = message("std_msgs/msg/Float64MultiArray")
NOT_UNDERSTOOD = (
    "ros2_arm.urdf: line 19, <command_interface>: 'voltage' is not understood",
    "ros2_arm.urdf: line 20, <joint>: there is no joint 'ghost'",
    "ros2_arm.urdf: line 24, <plugin>: the plugin 'libmystery.so' is not understood",
    "ros2_arm.urdf: line 27, <sensor>: a sensor of type 'altimeter' is not understood",
    "ros2_arm.urdf: line 28, <shutter>: not understood inside of <sensor>",
    "ros2_arm.yaml: line 13, <controller>: 'gripper': the type 'position_controllers/GripperActionController' is not understood",
    "ros2_arm.yaml: line 23, <spline>: is no parameter of 'arm_controller' that is understood",
)


def trajectory(names, *points):
    def made(seconds, positions, velocities=()):
        whole = int(seconds)
        time = make(message("builtin_interfaces/msg/Duration"), sec=whole, nanosec=round((seconds - whole) * 1e9))
        return make(POINT, positions=positions, velocities=list(velocities), time_from_start=time)

    return make(GOAL, joint_names=names, points=[made(*point) for point in points])


class Arm:
    def __init__(self, prefix=""):
        self.states = topic(f"{prefix}joint_states", "sensor_msgs/msg/JointState")
        self.tf = topic(f"{prefix}tf", "tf2_msgs/msg/TFMessage")
        self.follow = writer(f"rt/{prefix}arm_controller/joint_trajectory", GOAL)
        self.position, self.velocity, self.effort = (writer(f"rt/{prefix}{name}/commands", FORWARD) for name in ("arm_position", "spin_velocity", "push_effort"))

    def now(self):
        states = newest(self.states, "joints")
        return {name: (states.position[i], states.velocity[i], states.effort[i]) for i, name in enumerate(states.name)}

    def command(self, of, numbers, is_done):
        until("a subscription", of.get_matched_subscriptions)
        of.write(make(FORWARD, data=numbers))
        until("what was told", lambda: is_done(self.now()))


def begins(arm):
    states = arm.now()
    assert set(states) == {"shoulder", "elbow", "spin", "push"}, states
    near(states["elbow"][0], 0.25, 0.01, "initial_value")
    moving = transforms(until("frames", lambda: steps(1) or samples(arm.tf)))
    turn = moving["lower"].transform.rotation
    near(2 * math.atan2(turn.y, turn.w), -0.25, 0.01, "the elbow turns about -y")
    assert moving["lower"].header.frame_id == "upper" and moving["base"].header.frame_id == "world", moving


def follows(arm):
    """Half way between points joints are half way, and a trajectory replaces the one before it."""
    until("a subscription", arm.follow.get_matched_subscriptions)
    arm.follow.write(trajectory(["elbow", "shoulder"], (1.0, [0.45, 0.5]), (2.0, [0.45, -0.5])))
    begun = until("motion", lambda: [one for one in [arm.now()] if one["shoulder"][0] > 0.001])[0]
    at = begun["shoulder"][0] / 0.5
    steps(round((0.6 - at) / STEP))
    half = arm.now()
    shoulder, elbow = half["shoulder"][0], half["elbow"][0]
    assert 0.25 < shoulder < 0.42, half
    near((elbow - 0.25) / 0.2, shoulder / 0.5, 0.03, "both joints are as far")
    near(half["shoulder"][1], 0.5, 0.05, "the speed between points")
    steps(30)
    near(arm.now()["shoulder"][0], -0.5, 0.01, "the last point")
    arm.follow.write(trajectory(["shoulder"], (10.0, [1.2])))
    until("motion", lambda: arm.now()["shoulder"][0] > -0.45)
    arm.follow.write(trajectory(["shoulder"], (0.2, [0.1], [0.0])))
    until("the other trajectory", lambda: abs(arm.now()["shoulder"][0] - 0.1) < 0.01)
    steps(20)
    near(arm.now()["shoulder"][0], 0.1, 0.01, "it stays there")


def bad_trajectories(arm, simulator):
    for bad, reason in (
        (trajectory(["spin"], (1.0, [1.0])), "does not belong to this controller"),
        (trajectory(["shoulder"], (1.0, [1.0, 2.0])), "not one position for each joint"),
        (trajectory(["shoulder"], (1.0, [math.nan])), "no finite number"),
        (trajectory(["shoulder"], (1.0, [1.0]), (1.0, [0.0])), "do not increase"),
        (trajectory(["shoulder"]), "without points"),
    ):
        arm.follow.write(bad)
        simulator.logged(reason)
    near(arm.now()["shoulder"][0], 0.1, 0.01, "nothing has moved")


def acts(arm):
    action = ActionClient("arm_controller/follow_joint_trajectory", "control_msgs/action/FollowJointTrajectory")
    wanted = trajectory(["shoulder", "elbow"], (0.5, [0.6, 0.0]))
    assert action.send(trajectory=wanted).accepted
    steps(15)
    got = action.result()
    assert (got.status, got.result.error_code) == (SUCCEEDED, 0), got
    near(arm.now()["shoulder"][0], 0.6, 0.05, "the goal")
    feedback = samples(action.feedback)
    assert feedback and feedback[-1].feedback.joint_names == ["shoulder", "elbow"], feedback
    near(feedback[2].feedback.desired.positions[0], 0.1 + 0.5 * 3 / 10, 0.06, "feedback on the way")
    assert not action.send(trajectory=trajectory(["nose"], (1.0, [0.0]))).accepted
    assert action.send(trajectory=trajectory(["shoulder"], (5.0, [-1.0]))).accepted
    steps(10)
    assert action.cancel().return_code == 0
    steps(2)
    assert action.result().status == CANCELED
    held = arm.now()["shoulder"][0]
    steps(20)
    near(arm.now()["shoulder"][0], held, 0.02, "where it was cancelled")
    assert 0.2 < held < 0.6, held
    assert action.send(trajectory=trajectory(["shoulder"], (5.0, [-1.0]))).accepted
    steps(2)
    until("a subscription", arm.follow.get_matched_subscriptions)
    arm.follow.write(trajectory(["shoulder"], (0.2, [0.0])))
    until("the other trajectory", lambda: abs(arm.now()["shoulder"][0]) < 0.01)
    assert action.result().status == ABORTED, "another trajectory has replaced it"
    # Beyond what the joint may be told (1.5) it is not where its goal is, when the time for it is over.
    assert action.send(trajectory=trajectory(["shoulder"], (0.5, [1.9]))).accepted
    steps(30)
    got = action.result()
    assert (got.status, got.result.error_code) == (ABORTED, -5) and "shoulder" in got.result.error_string, got
    near(arm.now()["shoulder"][0], 1.5, 0.02, "the bound of what it is told")


def forwards(arm):
    arm.command(arm.position, [-0.3, 0.4], lambda now: abs(now["shoulder"][0] + 0.3) < 0.01 and abs(now["elbow"][0] - 0.4) < 0.01)
    arm.command(arm.velocity, [2.0], lambda now: abs(now["spin"][1] - 2.0) < 0.05)
    arm.command(arm.velocity, [-1.0], lambda now: abs(now["spin"][1] + 1.0) < 0.05)
    # 2 kg and 1 N: half a metre per second faster each second.
    near(arm.now()["push"][1], 0, 0.02, "it is pushed by nothing")
    arm.command(arm.effort, [1.0], lambda now: now["push"][1] > 0.02)
    before = arm.now()
    steps(19)
    after = arm.now()
    near(after["push"][1] - before["push"][1], 0.5, 0.05, "acceleration of a mass")
    near(after["push"][2], 1.0, 0.1, "effort")
    # Numbers that are not as many as joints change nothing.
    arm.velocity.write(make(FORWARD, data=[1.0, 2.0]))
    steps(10)
    near(arm.now()["spin"][1], -1.0, 0.05, "what it was told before")


def arms():
    with Simulator(ARM, "--fix-base", *OPTIONS) as simulator:
        for line in NOT_UNDERSTOOD:
            simulator.logged(f"not understood: {line}")
        arm = Arm()
        to(PAUSED)
        steps(4)
        begins(arm)
        follows(arm)
        bad_trajectories(arm, simulator)
        acts(arm)
        forwards(arm)


# ---------------------------------------------------------------- others


def spawned():
    """Entities in a namespace have their topics and frames there, and end with their topics."""
    with Simulator("tests/interop/ros2_interfaces_scene.lua", "--empty", *OPTIONS):
        for name, y in (("first", 3.0), ("second", -3.0)):
            spawn(name, uri=str(ROOT / ROVER), at=(0.0, y, 0.3), namespace=name)
        first, second = Rover("first/"), Rover("second/")
        to(PAUSED)
        steps(10)
        first.drive(0.3, 0.0, 1)
        near(newest(first.odometry, "odometry").twist.twist.linear.x, 0.3, 0.05, "the first one drives")
        near(newest(second.odometry, "odometry").twist.twist.linear.x, 0, 0.05, "the second one stands")
        assert "odom" == transforms(until("frames", lambda: steps(1) or samples(second.tf)))["base_link"].header.frame_id
        delete = Client("delete_entity", "simulation_interfaces/srv/DeleteEntity")
        assert delete(entity="first").result.result == 1
        steps(2)
        until("no publisher any more", lambda: steps(1) or not first.odometry.get_matched_publications())
        assert second.odometry.get_matched_publications()


def settings():
    """A scene with a TOML file beside it: its own camera, and joints by the names of objects."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for file in ("ros2_robot_scene.lua", "ros2_robot_scene.ros2.toml"):
            shutil.copy(ROOT / "tests/interop" / file, folder)
        with Simulator(str(folder / "ros2_robot_scene.lua"), "--empty", *OPTIONS) as simulator:
            simulator.logged("ros2_robot_scene.ros2.toml: line 4, <colour>: is not understood")
            simulator.logged("ros2_robot_scene.ros2.toml: line 10, <zoom>: is no parameter of 'eye' that is understood")
            simulator.logged("there is no link 'Nothing'")
            image = topic("r1/picture", "sensor_msgs/msg/Image")
            states = topic("r1/joint_states", "sensor_msgs/msg/JointState")
            command = writer("rt/r1/turn/commands", FORWARD)
            to(PAUSED)
            picture = newest(image, "a picture")
            assert (picture.width, picture.height, picture.header.frame_id) == (32, 16, "Eye"), picture
            until("a subscription", command.get_matched_subscriptions)
            command.write(make(FORWARD, data=[0.5]))
            joint = until("motion", lambda: [one for one in [newest(states, "joints")] if abs(one.position[0] - 0.5) < 1e-6])[0]
            assert joint.name == ["Hinge"], joint


for check in (rovers, arms, spawned, settings):
    check()
