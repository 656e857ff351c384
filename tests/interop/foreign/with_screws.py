"""screws 0.7, its bridge: the arm is read as screws, and driven in all of its modes."""

import sys

import numpy as np
import screws
from screws.coppelia import Scene, SimulatorNotRunning, connect

PORT = int(sys.argv[1])


def read(arm):
    assert arm.joint_types() == ('revolute',) * 6 and np.allclose(arm.joint_limits(), [-3, 3])
    model = arm.robot(inertias=True)
    assert model.link_inertias[0][5, 5] == 0.2, 'the mass of a link'
    angles = np.array([0.1, 0.2, 0.3, -0.1, -0.2, -0.3])
    arm.teleport(angles)
    # What it computes from the scene's joints is where the scene has the tip.
    assert np.allclose(arm.tip_frame(), screws.fk_space(model.M, model.S, angles), atol=1e-12)
    arm.teleport(np.zeros(6))


def drive(scene, arm):
    arm.mode('position')
    log = scene.run(lambda *_: np.full(6, 0.3), duration=1, arm=arm)
    assert len(log) == 50 and np.allclose(log.theta[-1], 0.3, atol=1e-3), log.theta[-1]
    assert np.all(np.isfinite(log.tau[-1]))
    scene.stop()
    arm.mode('velocity')
    assert np.allclose(scene.run(lambda *_: np.full(6, 0.1), duration=0.2, arm=arm).dtheta[-1], 0.1, atol=1e-3)
    scene.stop()
    arm.mode('torque')
    assert np.any(np.abs(scene.run(lambda *_: np.full(6, 0.01), duration=0.2, arm=arm).dtheta[-1]) > 1e-3)
    scene.stop()
    arm.mode('kinematic')
    log = scene.run(lambda time, *_: np.full(6, 0.1 * time), duration=0.2, arm=arm)
    assert np.allclose(log.theta[-1], log.command[-2]), 'exactly'
    scene.stop()


with Scene('localhost', PORT) as scene:
    scene.set_time_step(0.02)
    arm = scene.arm('/UR5')
    assert arm.tip_alias == 'tip' and arm.joint_names[0] == 'joint1'
    read(arm)
    drive(scene, arm)
    scene.show_frame(np.eye(4))
    scene.show_frame(np.eye(4))
    scene.clear_frames()
    assert scene.camera(resolution=(64, 48)) > 0
    scene.release()
    try:
        scene.frame('/nobody')
    except LookupError:
        pass
    else:
        raise AssertionError('it has found nobody')
sim = connect('localhost', PORT)
assert abs(sim.getSimulationTimeStep() - 0.05) < 1e-12, 'the scene is left as it was'
try:
    connect('localhost', 1, timeout_s=0.2)
except SimulatorNotRunning:
    pass
else:
    raise AssertionError('nobody listens there')
