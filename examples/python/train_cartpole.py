#!/usr/bin/env python3
"""Learns to balance the pole of scenes/inverted_pendulum.lua: a cross-entropy search over the four gains of a linear controller.

    pip install '.[gym]'
    python3 examples/python/train_cartpole.py [--rounds 12] [--plot curve.png]
"""

import argparse
import pathlib

import numpy

from swanilda.gym import SceneEnv, joint_position, joint_velocity, target_velocity

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua"
SAMPLES, BEST, STEPS = 24, 6, 200


def make():
    return SceneEnv(
        SCENE,
        observations=[
            joint_position("/Slider"),
            joint_velocity("/Slider"),
            joint_position("/Hinge"),
            joint_velocity("/Hinge"),
        ],
        actions=[target_velocity("/Slider", 5)],
        reward=lambda observation, action: 1.0 - 0.1 * abs(observation[0]),
        terminated=lambda observation: abs(observation[2]) > 0.35 or abs(observation[0]) > 1.5,
        max_steps=STEPS,
        prepare=lambda sim: sim.removeObjects([sim.getObject(path) for path in ("/Controller", "/Script")]),
        begin=lambda sim, rng: sim.setJointTargetVelocity(sim.getObject("/Slider"), rng.uniform(-0.2, 0.2)),
    )


def episode(env, gains, seed):
    """The return of one episode."""
    observation, _ = env.reset(seed=seed)
    total, done = 0.0, False
    while not done:
        action = numpy.clip([gains @ observation], -5, 5)
        observation, reward, terminated, truncated, _ = env.step(action)
        total, done = total + reward, terminated or truncated
    return total


def search(env, rounds, rng):
    """The gains that were best, and the mean return of each round's best samples."""
    mean, spread, curve = numpy.zeros(4), numpy.full(4, 5.0), []
    for turn in range(rounds):
        samples = mean + spread * rng.standard_normal((SAMPLES, 4))
        returns = numpy.array([episode(env, sample, seed=turn) for sample in samples])
        best = samples[numpy.argsort(returns)[-BEST:]]
        mean, spread = best.mean(axis=0), best.std(axis=0) + 0.1
        curve.append(float(numpy.sort(returns)[-BEST:].mean()))
        print(f"round {turn + 1:2}  {curve[-1]:6.1f}  " + "#" * round(40 * max(0, curve[-1]) / STEPS))
    return mean, curve


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=12)
    parser.add_argument("--plot", help="a picture of the curve (needs matplotlib)")
    args = parser.parse_args()
    env = make()
    gains, curve = search(env, args.rounds, numpy.random.default_rng(1))
    print("gains", gains.round(2), "return", round(episode(env, gains, seed=100), 1))
    if args.plot:
        from matplotlib import pyplot

        pyplot.plot(range(1, len(curve) + 1), curve)
        pyplot.xlabel("round")
        pyplot.ylabel("return")
        pyplot.savefig(args.plot)


if __name__ == "__main__":
    main()
