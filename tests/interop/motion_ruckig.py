"""Trajectories of sim.ruckigPos and sim.ruckigVel against the official Ruckig: random problems, the same durations and states.

rsruckig 3.0.1 does not check the jerk of one kind of synchronised velocity profile: then an axis that has to wait gets to its target
early, with too much jerk. So a few axes of velocity problems may be elsewhere on the way, if the duration agrees.
"""

import json
import pathlib
import random
import subprocess
import sys
import tempfile

import ruckig

COUNT = 300  # of each kind
MOST_RUSHED = 6
STEP = 0.1
CYCLE = 0.0001
SAMPLES = 5
SYNC = {0: ruckig.Synchronization.Phase, 1: ruckig.Synchronization.Time, 3: ruckig.Synchronization.No}
SCRIPT = """
local json = require 'dkjson'
function sysCall_init()
    for line in io.lines(INPUT) do
        local p = json.decode(line)
        local start = p.velocity and sim.ruckigVel or sim.ruckigPos
        local h = start(p.dofs, CYCLE, p.flags, p.current, p.limits, p.selection, p.target)
        local results, left = {}, 0
        for i = 1, SAMPLES do
            local result, pva, sync = sim.ruckigStep(h, STEP)
            if i == 1 then left = sync end
            results[i] = {result, pva}
        end
        sim.ruckigRemove(h)
        print('result ' .. json.encode({left + STEP, results}))
    end
end
"""


def problem(rng, velocity):
    dofs = rng.randint(1, 4)
    vector = lambda low, high: [rng.uniform(low, high) for _ in range(dofs)]
    limits = {"velocity": vector(0.5, 3), "acceleration": vector(0.5, 4), "jerk": vector(1, 20)}
    minima = rng.random() < 0.4
    low_velocity = [-rng.uniform(0.5, 3) if minima else -v for v in limits["velocity"]]
    low_acceleration = [-rng.uniform(0.5, 4) if minima else -a for a in limits["acceleration"]]
    at_rest = rng.random() < 0.2
    scale = 0.0 if at_rest else 0.9
    between = lambda lows, highs, share: [share * rng.uniform(l, h) for l, h in zip(lows, highs)]
    current = [vector(-2, 2), between(low_velocity, limits["velocity"], scale), between(low_acceleration, limits["acceleration"], scale / 3)]
    target = between(low_velocity, limits["velocity"], scale)
    return {
        "dofs": dofs, "velocity": velocity, "sync": rng.choice(list(SYNC)), "minima": minima, "limits": limits,
        "low": [low_velocity, low_acceleration], "current": current, "target": [vector(-2, 2), target],
    }


def for_lua(p):
    used = ["acceleration", "jerk"] if p["velocity"] else ["velocity", "acceleration", "jerk"]
    lows = p["low"][1:] if p["velocity"] else p["low"]
    limits = [p["limits"][name] for name in used] + (lows if p["minima"] else [])
    target = p["target"][1:] if p["velocity"] else p["target"]
    flags = p["sync"] | (0x200 | (0 if p["velocity"] else 0x100) if p["minima"] else 0)
    flat = lambda lists: [x for part in lists for x in part]
    return {
        "dofs": p["dofs"], "velocity": p["velocity"], "flags": flags, "current": flat(p["current"]), "limits": flat(limits),
        "selection": [1] * p["dofs"], "target": flat(target),
    }


def official(p):
    """The trajectory, or nothing where Ruckig finds the problem impossible."""
    given = ruckig.InputParameter(p["dofs"])
    if p["velocity"]:
        given.control_interface = ruckig.ControlInterface.Velocity
    given.synchronization = SYNC[p["sync"]]
    given.current_position, given.current_velocity, given.current_acceleration = p["current"]
    given.target_position, given.target_velocity = p["target"]
    given.max_velocity, given.max_acceleration, given.max_jerk = p["limits"].values()
    if p["minima"]:
        given.min_acceleration = p["low"][1]
        if not p["velocity"]:
            given.min_velocity = p["low"][0]
    trajectory = ruckig.Trajectory(p["dofs"])
    result = ruckig.Ruckig(p["dofs"]).calculate(given, trajectory)
    return trajectory if result in (ruckig.Result.Working, ruckig.Result.Finished) else None


def worst(p, trajectory, answer):
    """Largest difference in duration and states while both move; -1 where both say that there is no trajectory."""
    duration, results = answer
    refused = results[0][0] < 0
    if trajectory is None or refused:
        return -1 if trajectory is None and refused else float("inf")
    differences = [abs(duration - trajectory.duration)]
    for i, (_, state) in enumerate(results, 1):
        if i * STEP < trajectory.duration:
            expected = [x for part in trajectory.at_time(i * STEP) for x in part]
            differences += [abs(a - b) for a, b in zip(state, expected)]
    return max(differences)


def is_rushed(p, answer):
    """Whether an axis is at its target early, in a synchronised velocity problem whose duration agrees."""
    trajectory = official(p)
    same = trajectory is not None and abs(answer[0] - trajectory.duration) < 1e-6
    return same and p["velocity"] and p["dofs"] > 1 and p["sync"] != 3


def ours(problems):
    with tempfile.TemporaryDirectory() as folder:
        given, script = pathlib.Path(folder, "problems.json"), pathlib.Path(folder, "ruckig.lua")
        given.write_text("".join(json.dumps(for_lua(p)) + "\n" for p in problems))
        facts = f"local INPUT, CYCLE, STEP, SAMPLES = {json.dumps(str(given))}, {CYCLE}, {STEP}, {SAMPLES}\n"
        script.write_text("sim = require 'sim'\n" + facts + SCRIPT)
        line = [sys.argv[1], "run", str(script), "--time", "0.05", "--json"]
        out = subprocess.run(line, stdout=subprocess.PIPE, timeout=60, check=True).stdout
    texts = [json.loads(line).get("text", "") for line in out.splitlines()]
    return [json.loads(text[len("result ") :]) for text in texts if text.startswith("result ")]


def main():
    rng = random.Random(1)
    problems = [problem(rng, velocity) for velocity in (False, True) for _ in range(COUNT)]
    answers = ours(problems)
    if len(answers) != len(problems):
        sys.exit(f"{len(answers)} answers to {len(problems)} problems")
    differences = [worst(p, official(p), answer) for p, answer in zip(problems, answers)]
    rushed = [i for i, d in enumerate(differences) if d > 1e-6 and is_rushed(problems[i], answers[i])]
    wrong = [i for i, d in enumerate(differences) if d > 1e-6 and (i not in rushed or len(rushed) > MOST_RUSHED)]
    for i in wrong[:5]:
        print(f"problem {i}: {differences[i]}: {problems[i]}", answers[i][0], getattr(official(problems[i]), "duration", None))
    if wrong:
        sys.exit(f"{len(wrong)} of {len(problems)} differ")
    if "-v" in sys.argv:
        print(f"{len(problems)} problems, {differences.count(-1)} refused by both, {len(rushed)} rushed, the others within", end=" ")
        print(f"{max(d for i, d in enumerate(differences) if i not in rushed):.2g}")


main()
