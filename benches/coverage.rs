//! What counting lines costs scripts that are watched, as they are in tests.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use swanilda::scene::Data;
use swanilda::{Limits, Options, ScriptKind, Simulator};

/// Rounds of the loops.
const ROUNDS: u64 = 20_000;

const SCRIPT: &str = "
sim = require 'sim'
function sysCall_init()
    joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
end

-- Nothing but Lua; all of it runs.
function loop(n)
    local sum = 0
    for i = 1, n do
        local x = i * 2
        sum = sum + x
    end
    return sum
end

-- The same with a branch that is never taken, so that there is always something left to find.
function loopWithMiss(n)
    local sum = 0
    for i = 1, n do
        local x = i * 2
        if x < 0 then
            error('negative')
        end
        sum = sum + x
    end
    return sum
end

local function clamp(v, lo, hi)
    if v < lo then return lo end
    if v > hi then return hi end
    return v
end

-- A controller: a few calls of the simulator and some arithmetic.
local gains = { kp = 1, ki = 0.1, kd = 0.01 }
function controller(n)
    local integral, last = 0, 0
    for _ = 1, n do
        local position = sim.getJointPosition(joint)
        local err = 1 - position
        integral = clamp(integral + err * 0.05, -1, 1)
        local u = gains.kp * err + gains.ki * integral + gains.kd * (err - last) / 0.05
        last = err
        sim.setJointPosition(joint, position + clamp(u, -1, 1) * 0.05)
    end
end

-- The same with branches that are not taken.
function controllerWithMiss(n)
    local integral, last = 0, 0
    for _ = 1, n do
        local position = sim.getJointPosition(joint)
        if position ~= position then
            error('the joint is broken')
        end
        local err = 1 - position
        integral = clamp(integral + err * 0.05, -1, 1)
        local u = gains.kp * err + gains.ki * integral + gains.kd * (err - last) / 0.05
        last = err
        if u > 1e6 then
            u = 0
        end
        sim.setJointPosition(joint, position + clamp(u, -1, 1) * 0.05)
    end
end
";

fn coverage(criterion: &mut Criterion) {
    for function in ["loop", "loopWithMiss", "controller", "controllerWithMiss"] {
        let mut group = criterion.benchmark_group(function);
        group.throughput(Throughput::Elements(ROUNDS));
        for (name, count_lines) in [("watched", false), ("counted", true)] {
            let limits = Some(Limits { memory: 1 << 30 });
            let mut sim = Simulator::new(Options {
                limits,
                count_lines,
                ..Options::default()
            });
            let script = sim
                .add_script(ScriptKind::Customization, "bench", SCRIPT.as_bytes())
                .expect("the script loads");
            group.bench_function(name, |bencher| {
                bencher.iter(|| {
                    sim.call(&script, function, &[Data::Int(ROUNDS as i64)])
                        .expect("the function works")
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, coverage);
criterion_main!(benches);
