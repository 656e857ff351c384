#python
# A robot arm with one joint, moved by a thread in Python: to three angles in turn. Run it:
#
#     swanilda run scenes/python_robot.py --time 3
#
# Needs python3 (3.9 or newer), and no packages.
import math


def sysCall_init():
    global sim
    sim = require('sim')
    self.base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.2, 0.2, 0.1], 0)
    self.joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    self.arm = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.4, 0.05, 0.05], 0)
    sim.setObjectParent(self.joint, self.base, True)
    sim.setObjectPosition(self.joint, [0, 0, 0.1], self.base)
    sim.setObjectParent(self.arm, self.joint, True)
    sim.setObjectPosition(self.arm, [0.2, 0, 0], self.joint)
    self.lowest, self.highest = 0.0, 0.0


def sysCall_thread():
    sim.setStepping(True)
    for degrees in (90, -45, 0):
        move_to(math.radians(degrees))
        x, y, _ = sim.getObjectPosition(self.arm)
        print(f'{degrees:4d} degrees: arm at {x:.3f}, {y:.3f} after {sim.getSimulationTime():.2f} s')


def move_to(target, speed=3.0):
    """Turns the joint at a constant speed, one step of the simulation at a time."""
    while not sim.getSimulationStopping():
        angle = sim.getJointPosition(self.joint)
        step = speed * sim.getSimulationTimeStep()
        if abs(target - angle) <= step:
            sim.setJointPosition(self.joint, target)
            sim.step()
            return
        sim.setJointPosition(self.joint, angle + math.copysign(step, target - angle))
        sim.step()


def sysCall_sensing():
    angle = sim.getJointPosition(self.joint)
    self.lowest, self.highest = min(self.lowest, angle), max(self.highest, angle)


def sysCall_afterSimulation():
    print(f'between {math.degrees(self.lowest):.1f} and {math.degrees(self.highest):.1f} degrees')
