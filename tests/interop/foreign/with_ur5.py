"""ur5-lab-helper 1.0.2: its functions as the experiments of the course call them. It always connects to the client's default port."""

import functools
import sys
import time

import coppeliasim_zmqremoteapi_client as client

client.RemoteAPIClient = functools.partial(client.RemoteAPIClient, port=int(sys.argv[1]))
import helper

assert len(helper.joints) == 6 and helper.dist([0, 0, 0], [3, 4, 0]) == 5
assert helper.dist(helper.tip_pos(), [0, 0, 0.7]) < 1e-9
for move in (helper.go_to, helper.jump, helper.line_to):
    move(0.2, 0.1, 0.5)
    assert helper.dist(helper.sim.getObjectPosition(helper.target), [0.2, 0.1, 0.5]) < 1e-9
ball = helper.sim.getObject('/Sphere')
# It takes the first result of sim.getShapeColor for a colour, which it is not, and then asks the camera.
assert helper.get_color(ball) == 'GREEN' and helper.get_shape(ball) == 'SPHERE'
for action in (helper.open_hand, helper.close_hand, lambda: helper.pick(ball, 1, 1)):
    try:
        action()
    except RuntimeError as error:
        assert 'No gripper joints found' in str(error)
    else:
        raise AssertionError('this arm has no hand')
helper.finish()
for _ in range(500):
    if helper.sim.getSimulationState() == helper.sim.simulation_stopped:
        break
    time.sleep(0.02)
else:
    raise AssertionError('the simulation does not stop')
