"""dqrobotics-interface-coppeliasim-zmq 25.4.0a19, a client in C++: handles, joints, steps, errors.

What takes or returns a pose does not work in this version, with any simulator: it does not know the class of poses of its own dqrobotics.
"""

import sys

import numpy as np
from dqrobotics.interfaces.coppeliasim import DQ_CoppeliaSimInterfaceZMQ

JOINTS = ['joint%d' % i for i in range(1, 7)]

robot = DQ_CoppeliaSimInterfaceZMQ()
assert robot.connect('127.0.0.1', int(sys.argv[1]), 5000)
assert robot.get_object_handle('joint1') == robot.get_object_handle('/UR5/joint1')
robot.set_stepping_mode(True)
robot.set_joint_positions(JOINTS, np.full(6, 0.1))
assert np.allclose(robot.get_joint_positions(JOINTS), 0.1)

robot.start_simulation()
robot.set_joint_target_positions(JOINTS, np.full(6, 0.2))
for _ in range(40):
    robot.trigger_next_simulation_step()
assert np.allclose(robot.get_joint_positions(JOINTS), 0.2, atol=1e-3)
assert np.allclose(robot.get_joint_velocities(JOINTS), 0, atol=1e-3)
assert abs(robot.get_joint_torques(JOINTS)[1]) > 0.1  # it holds the arm, which leans
robot.set_joint_target_velocities(JOINTS, np.full(6, 0.2))
robot.set_joint_torques(JOINTS, np.full(6, 0.2))
try:
    robot.get_object_handle('nobody')
except RuntimeError as error:
    assert 'object does not exist' in str(error), error
else:
    raise AssertionError('it has found nobody')
robot.stop_simulation()
robot.disconnect()
