#!/usr/bin/env python3
"""Gymnasium's half cheetah learns to run: a linear controller, by augmented random search (Mania, Guy and Recht, 2018) on many worlds.

    pip install '.[gym]'
    python3 examples/python/train_cheetah.py [--rounds 60] [--plot curve.svg] [--record run.swr]
    swanilda view run.swr

The robot is the MJCF file in the package gymnasium. In each round every direction of the search has a world for each of its two signs.
"""

import argparse
import os
import pathlib
import time

import gymnasium
import numpy

from swanilda import vec
from swanilda.gym import joint_position, joint_velocity, target_force

FILE = pathlib.Path(gymnasium.__file__).parent / "envs/mujoco/assets/half_cheetah.xml"
SCENE = pathlib.Path(__file__).parent / "mjcf_robot.lua"
# The torques of the motors at full control, N m.
GEARS = {"bthigh": 120, "bshin": 90, "bfoot": 60, "fthigh": 120, "fshin": 60, "ffoot": 30}
JOINTS = ["rootz", "rooty", *GEARS]
DIRECTIONS, BEST, STEP_SIZE, NOISE = 32, 8, 0.02, 0.03
STEPS = 500


def robot(name):
    return f"/world_respondable/{name}"


def make(worlds, **options):
    control = " + ".join(f"(a[{at + 1}] / {gear}) ^ 2" for at, gear in enumerate(GEARS.values()))
    return vec.make(
        SCENE,
        worlds,
        observations=[
            *(joint_position(robot(name)) for name in JOINTS),
            *(joint_velocity(robot(name)) for name in ["rootx", *JOINTS]),
        ],
        actions=[target_force(robot(name), gear) for name, gear in GEARS.items()],
        reward=f"o[{len(JOINTS) + 1}] - 0.1 * ({control})",
        max_steps=STEPS,
        params={"file": str(FILE), "step": "0.01", "time": "0.05"},
        autoreset="Disabled",
        **options,
    )


class Normal:
    """Mean and spread of all observations so far (Welford)."""

    def __init__(self, width):
        self.count, self.mean, self.squares = 0, numpy.zeros(width), numpy.ones(width)

    def add(self, observations):
        count = len(observations)
        mean = observations.mean(axis=0)
        change = mean - self.mean
        total = self.count + count
        self.squares += ((observations - mean) ** 2).sum(axis=0) + change**2 * self.count * count / total
        self.mean += change * count / total
        self.count = total

    def __call__(self, observations):
        return (observations - self.mean) / numpy.sqrt(self.squares / max(self.count, 1) + 1e-8)


def returns(envs, controllers, normal, learn=True, record=None):
    """The return of an episode with each world's controller; `record` is the file for a recording of the first world."""
    torques = numpy.array(list(GEARS.values()))
    observations, _ = envs.reset(options={"record": {0: record}} if record else None)
    total, seen = numpy.zeros(envs.num_envs), []
    for _ in range(STEPS):
        seen.append(observations)
        actions = numpy.einsum("nij,nj->ni", controllers, normal(observations))
        observations, rewards, *_ = envs.step(torques * numpy.clip(actions, -1, 1))
        total += rewards
    if learn:
        normal.add(numpy.concatenate(seen))
    return total


def search(rounds, threads=None):
    """The controller after so many rounds, and the mean return of each round."""
    envs, rng = make(2 * DIRECTIONS, threads=threads), numpy.random.default_rng(1)
    envs.reset(seed=1)
    shape = (len(GEARS), envs.single_observation_space.shape[0])
    controller, normal, curve, began = numpy.zeros(shape), Normal(shape[1]), [], time.perf_counter()
    for number in range(rounds):
        directions = rng.standard_normal((DIRECTIONS, *shape))
        tried = numpy.concatenate([controller + NOISE * directions, controller - NOISE * directions])
        plus, minus = returns(envs, tried, normal).reshape(2, DIRECTIONS)
        best = numpy.argsort(-numpy.maximum(plus, minus))[:BEST]
        spread = numpy.concatenate([plus[best], minus[best]]).std() + 1e-8
        controller += STEP_SIZE / (BEST * spread) * numpy.einsum("n,nij->ij", (plus - minus)[best], directions[best])
        curve.append(numpy.concatenate([plus, minus]).mean())
        steps = (number + 1) * 2 * DIRECTIONS * STEPS / (time.perf_counter() - began)
        print(f"round {number + 1}: return {curve[-1]:.0f}, best {max(plus.max(), minus.max()):.0f}; {steps:.0f} steps/s", flush=True)
    envs.close()
    return controller, normal, curve


def plot(curve, path):
    """The curve as SVG."""
    low, high = min(curve), max(curve)
    x = numpy.linspace(40, 630, len(curve))
    y = 290 - 270 * (numpy.array(curve) - low) / max(high - low, 1e-9)
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
    text = f'<text x="40" y="14" font-size="12">mean return of a round: {low:.0f} to {high:.0f} in {len(curve)} rounds</text>'
    line = f'<polyline fill="none" stroke="#06c" stroke-width="2" points="{points}"/>'
    pathlib.Path(path).write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="640" height="300">{text}{line}</svg>\n')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=60)
    parser.add_argument("--plot", help="write the curve of returns to this SVG file")
    parser.add_argument("--record", help="record an episode with what was learned in this file, for `swanilda view`")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    options = parser.parse_args()
    controller, normal, curve = search(options.rounds, options.threads)
    if options.plot:
        plot(curve, options.plot)
    envs = make(1)
    envs.reset(seed=100)
    result = returns(envs, controller[None], normal, learn=False, record=options.record)[0]
    print(f"an episode of {STEPS * 0.05:.0f} s with what was learned: return {result:.0f}")


if __name__ == "__main__":
    main()
