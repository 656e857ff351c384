"""guira 0.1, by the legacy remote API: handles, poses, boxes, wheels, a sensor, streams."""

import sys

import numpy as np
from guira import sim
from guira.guira_exceptions import SimulatorException
from guira.robot import Robot
from guira.scene import Scene
from guira.sensors import Ultrasonic

scene = Scene()
client = scene.connect(connection_port=int(sys.argv[1]))
assert scene.test_connection() > 20
ball = scene.get_object_handle('Sphere')
[told] = scene.get_scene_objects_info(['Sphere'])
assert told['handler'] == ball and np.allclose(told['position'], [1, 1, 0.05]), told
corners = scene.get_bounding_box(scene.get_object_handle('UR5'), 'global', 'object', True)
assert np.allclose(np.ptp(corners, axis=0), [0.2, 0.2, 0.1]) and np.allclose(np.mean(corners, axis=0), [0, 0, 0.05]), corners
model = scene.get_bounding_box(scene.get_object_handle('UR5'), 'local', 'model', True)
assert np.max(model, axis=0)[2] > 0.5, model
try:
    scene.get_object_handle('nobody')
except SimulatorException as error:
    assert 'Error code = 8' in str(error), error
else:
    raise AssertionError('it has found nobody')

robot = Robot(scene.get_object_handle('joint1'), scene.get_object_handle('joint2'), client)
assert robot.run(1, 2) == (0, 0)
assert sim.simxStartSimulation(client, sim.simx_opmode_blocking) in (0, 1)
distance = 0
for _ in range(200):
    distance = Ultrasonic(client, scene.get_object_handle('eye')).read()
    if distance > 0:
        break
assert abs(distance - 0.95) < 0.01, distance
scene.send_points_to_sim([np.array([1.0, 2.0, 3.0])])
assert sim.simxStopSimulation(client, sim.simx_opmode_blocking) in (0, 1)
sim.simxFinish(client)
