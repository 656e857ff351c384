"""Inverse kinematics of a UR5 and a Panda by other solvers: the tasks of crates/kinematics/benches.

    python3 -m venv target/venv && target/venv/bin/pip install numpy pin optik-py pytracik ikpy mink "qpsolvers[daqp]" roboticstoolbox-python
    target/venv/bin/python benches/compare/kinematics.py [number of poses]

Poses are those of random postures within the limits; the start is the middle of the limits. Every answer is checked at 0.1 mm and 1 mrad and for the limits
by forward kinematics written here. Times include the call from Python. Solvers that are not installed are left out.
"""

import math
import statistics
import sys
import tempfile
import time

import numpy as np

ACCURACY = 1e-4, 1e-3
Q = math.pi / 2


def step(x, y, z, about_x):
    c, s = math.cos(about_x), math.sin(about_x)
    return np.array([[1, 0, 0, x], [0, c, -s, y], [0, s, c, z], [0, 0, 0, 1]])


class Arm:
    """Revolute joints about z with fixed transforms before them and to the tip."""

    def __init__(self, name, before, to_tip, limits):
        self.name, self.before, self.to_tip = name, before, to_tip
        self.low, self.high = (np.array(side) for side in zip(*limits))

    def forward(self, config):
        pose = np.eye(4)
        for before, q in zip(self.before, config):
            c, s = math.cos(q), math.sin(q)
            pose = pose @ before @ np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        return pose @ self.to_tip

    def reaches(self, config, goal):
        tip = self.forward(config)
        turn = tip[:3, :3].T @ goal[:3, :3]
        sine = np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
        angle = math.atan2(sine, np.trace(turn) - 1)
        near = np.linalg.norm(tip[:3, 3] - goal[:3, 3]) < ACCURACY[0] and angle < ACCURACY[1]
        return near and np.all(config >= self.low - 1e-9) and np.all(config <= self.high + 1e-9)

    def urdf(self):
        def origin(m):
            # All fixed transforms turn about x only.
            return f'<origin xyz="{m[0, 3]} {m[1, 3]} {m[2, 3]}" rpy="{math.atan2(m[2, 1], m[1, 1])} 0 0"/>'

        body = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
        lines = [f'<robot name="{self.name}"><link name="base"/>']
        parent = "base"
        for i, before in enumerate(self.before):
            limit = f'<limit lower="{self.low[i]}" upper="{self.high[i]}" effort="1" velocity="1"/>'
            lines.append(f'<link name="link{i}">{body}</link><joint name="joint{i}" type="revolute"><parent link="{parent}"/>'
                         f'<child link="link{i}"/>{origin(before)}<axis xyz="0 0 1"/>{limit}</joint>')
            parent = f"link{i}"
        lines.append(f'<link name="tip">{body}</link><joint name="end" type="fixed"><parent link="{parent}"/><child link="tip"/>'
                     f"{origin(self.to_tip)}</joint></robot>")
        file = tempfile.NamedTemporaryFile("w", suffix=".urdf", delete=False)
        file.write("\n".join(lines))
        file.close()
        return file.name

    def mjcf(self):
        """Bodies in bodies. All fixed transforms turn about x only."""
        text, ends = '<mujoco><compiler angle="radian"/><worldbody>', ""
        for before, low, high in zip(self.before, self.low, self.high):
            text += (f'<body pos="{before[0, 3]} {before[1, 3]} {before[2, 3]}" euler="{math.atan2(before[2, 1], before[1, 1])} 0 0">'
                     f'<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint axis="0 0 1" range="{low} {high}" limited="true"/>')
            ends += "</body>"
        m = self.to_tip
        return text + (f'<site name="tip" pos="{m[0, 3]} {m[1, 3]} {m[2, 3]}" euler="{math.atan2(m[2, 1], m[1, 1])} 0 0"/>'
                       f"{ends}</worldbody></mujoco>")


def ur5():
    rows = [(0.089159, 0, Q), (0, -0.425, 0), (0, -0.39225, 0), (0.10915, 0, Q), (0.09465, 0, -Q), (0.0823, 0, 0)]
    steps = [step(a, 0, d, alpha) for d, a, alpha in rows]
    return Arm("UR5", [np.eye(4)] + steps[:-1], steps[-1], [(-math.pi, math.pi)] * 6)


def panda():
    rows = [(0, 0.333, 0), (0, 0, -Q), (0, 0.316, Q), (0.0825, 0, Q), (-0.0825, 0.384, -Q), (0, 0, Q), (0.088, 0, Q)]
    limits = [(-2.8973, 2.8973), (-1.7628, 1.7628), (-2.8973, 2.8973), (-3.0718, -0.0698), (-2.8973, 2.8973),
              (-0.0175, 3.7525), (-2.8973, 2.8973)]
    return Arm("Panda", [step(a, 0, 0, alpha) @ step(0, 0, d, 0) for a, d, alpha in rows], step(0, 0, 0.107, 0), limits)


def optik(arm):
    from optik import Robot, SolverConfig

    robot = Robot.from_urdf_file(arm.urdf(), "base", "tip")
    config = SolverConfig(max_time=0.05, tol_f=1e-10)

    def solve(goal, start):
        found = robot.ik(config, goal, start.tolist())
        return None if found is None else np.array(found[0])

    return solve


def trac_ik(arm):
    from trac_ik import TracIK

    solver = TracIK("base", "tip", arm.urdf(), timeout=0.05, epsilon=1e-5)
    return lambda goal, start: solver.ik(goal[:3, 3], goal[:3, :3], seed_jnt_values=start)


def pinocchio(arm):
    import pinocchio as pin

    model = pin.buildModelFromUrdf(arm.urdf())
    data, frame = model.createData(), model.getFrameId("tip")

    def solve(goal, start):
        """Damped least squares from one start, at most 200 iterations."""
        q, goal = start.copy(), pin.SE3(goal)
        for _ in range(200):
            pin.framesForwardKinematics(model, data, q)
            error = pin.log6(data.oMf[frame].inverse() * goal).vector
            if np.linalg.norm(error) < 1e-5:
                break
            jacobian = pin.computeFrameJacobian(model, data, q, frame)
            q = q + jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-4 * np.eye(6), error)
            q = np.clip(q, arm.low, arm.high)
        return q

    return solve


def roboticstoolbox(arm):
    from roboticstoolbox import ET, ETS

    steps = []
    for before, limits in zip(arm.before, zip(arm.low, arm.high)):
        steps += [ET.SE3(before), ET.Rz(qlim=limits)]
    robot = ETS(steps + [ET.SE3(arm.to_tip)])

    def solve(goal, start):
        """Levenberg-Marquardt in C++, at most 100 searches of 30 iterations."""
        found = robot.ik_LM(goal, q0=start, tol=1e-10, joint_limits=True)
        return found.q if found.success else None

    return solve


def mink(arm):
    import mink as m
    import mujoco

    model = mujoco.MjModel.from_xml_string(arm.mjcf())
    configuration = m.Configuration(model)
    task = m.FrameTask("tip", "site", position_cost=1.0, orientation_cost=1.0)
    limits = [m.ConfigurationLimit(model)]

    def solve(goal, start):
        """Steps of differential kinematics with limits (a quadratic programme each) from one start, at most 50."""
        configuration.update(start.copy())
        task.set_target(m.SE3.from_matrix(goal))
        for _ in range(50):
            if np.linalg.norm(task.compute_error(configuration)) < 1e-5:
                break
            velocity = m.solve_ik(configuration, [task], 1.0, "daqp", 1e-6, limits=limits)
            configuration.integrate_inplace(velocity, 1.0)
        return configuration.q.copy()

    return solve


def ikpy(arm):
    from ikpy.chain import Chain

    chain = Chain.from_urdf_file(arm.urdf(), base_elements=["base"], active_links_mask=[False] + [True] * len(arm.low) + [False])

    def solve(goal, start):
        initial = np.concatenate([[0], start, [0]])
        return chain.inverse_kinematics_frame(goal, initial_position=initial, orientation_mode="all")[1:-1]

    return solve


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    print("| arm, solver | success | mean | median |\n|---|---|---|---|")
    for arm in (ur5(), panda()):
        random = np.random.default_rng(2024)
        goals = [arm.forward(arm.low + random.random(len(arm.low)) * (arm.high - arm.low)) for _ in range(count)]
        start = (arm.low + arm.high) / 2
        for make, share in ((optik, 1), (trac_ik, 1), (roboticstoolbox, 1), (pinocchio, 0.2), (mink, 0.2), (ikpy, 0.02)):
            try:
                solve = make(arm)
            except ImportError:
                continue
            times, successes, some = [], 0, goals[:max(1, int(count * share))]
            for goal in some:
                begin = time.perf_counter()
                config = solve(goal, start)
                times.append((time.perf_counter() - begin) * 1e6)
                successes += config is not None and bool(arm.reaches(np.asarray(config), goal))
            print(f"| {arm.name}, {make.__name__} ({len(some)} poses) | {100 * successes / len(some):.1f} % | "
                  f"{statistics.mean(times):.0f} us | {statistics.median(times):.0f} us |", flush=True)


if __name__ == "__main__":
    main()
