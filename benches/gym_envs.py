"""Steps per second of gymnasium environments: the pendulum of examples/python/train_cartpole.py, and MuJoCo's InvertedPendulum-v5.

    python3 -m pip install '.[gym]' 'gymnasium[mujoco]' && python3 benches/gym_envs.py

Medians, with random actions. A step is 50 ms in 10 sub-steps here and 40 ms in 2 there, so that the
time of a sub-step is written too.
"""

import pathlib
import statistics
import sys
import time

import gymnasium

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "examples/python"))
import train_cartpole  # noqa: E402

STEPS = 20_000


def measure(name, env, sub_steps):
    env.action_space.seed(0)
    steps, resets = [], []
    env.reset(seed=0)
    for _ in range(STEPS):
        action = env.action_space.sample()
        begun = time.perf_counter()
        _, _, terminated, truncated, _ = env.step(action)
        stepped = time.perf_counter()
        steps.append(stepped - begun)
        if terminated or truncated:
            env.reset()
            resets.append(time.perf_counter() - stepped)
    step, reset = statistics.median(steps), statistics.median(resets)
    print(f"{name}: {1 / step:.0f} steps/s, {step / sub_steps * 1e6:.1f} us per sub-step; a reset takes {reset * 1e6:.0f} us")


def main():
    measure("Swanilda, scenes/inverted_pendulum.lua", train_cartpole.make(), 10)
    measure("MuJoCo, InvertedPendulum-v5", gymnasium.make("InvertedPendulum-v5"), 2)


if __name__ == "__main__":
    main()
