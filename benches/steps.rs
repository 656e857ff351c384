//! How fast a simulation advances: with many scripts, and with many bodies.

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use swanilda::{Options, ScriptKind, Simulator};

/// As in the command: each simulator has memory of its own.
#[global_allocator]
static ALLOCATOR: swanilda::Allocator = swanilda::Allocator;

/// Builds so many dummies with an empty child script each.
const CHILDREN: &str = "
sim = require 'sim'
local code = 'function sysCall_init() end function sysCall_actuation() end function sysCall_sensing() end'
for _ = 1, COUNT do
    local script = sim.createScript(sim.scripttype_simulation, code)
    sim.setObjectParent(script, sim.createDummy(0.1), true)
end
";

/// 100 cuboids above the floor, 5 x 5 x 4.
const PILE: &str = "
sim = require 'sim'
for i = 0, 99 do
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(box, {i % 5 * 0.11, i // 5 % 5 * 0.11, 0.1 + i // 25 * 0.12})
    sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(box, sim.shapeintparam_respondable, 1)
    sim.setShapeMass(box, 1)
end
";

/// An arm of seven joints in position control, which a script moves.
const ARM: &str = "
sim = require 'sim'
local joints, parent = {}, sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.1})
for i = 1, 7 do
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, {0, 0, 0.16 * i})
    sim.setObjectOrientation(joint, i % 2 == 1 and {0, 0, 0} or {-math.pi / 2, 0, 0})
    sim.setObjectParent(joint, parent, true)
    sim.setIntProperty(joint, 'dynCtrlMode', sim.jointdynctrl_position)
    sim.setJointTargetForce(joint, 200)
    parent = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.06, 0.06, 0.14})
    sim.setObjectPosition(parent, {0, 0, 0.16 * i + 0.08})
    sim.setShapeMass(parent, 2.5 - 0.3 * i)
    sim.setObjectParent(parent, joint, true)
    sim.setBoolProperty(parent, 'dynamic', true)
    joints[i] = joint
end
function sysCall_actuation()
    local t = sim.getSimulationTime()
    for i = 1, 7 do sim.setJointTargetPosition(joints[i], 0.6 * math.sin(1.5 * t + i)) end
end
";

/// 1000 objects that move in every step, and nobody, one or one choosy listener.
const MOVING: &str = "
sim = require 'sim'
local objects = {}
for i = 1, 1000 do objects[i] = sim.createDummy(0.01) end
local x = 0
function sysCall_actuation()
    x = x + 0.001
    for i = 1, 1000 do sim.setObjectPosition(objects[i], {x, i, 0}) end
end
";
/// 1000 objects, each ten levels deep, on a hundred bases; a script moves the bases or leaves them, and reads all world poses.
const DEEP: &str = "
sim = require 'sim'
local bases, objects = {}, {}
for i = 1, 100 do
    local parent = -1
    for level = 1, 9 do
        local dummy = sim.createDummy(0.01)
        sim.setObjectPosition(dummy, {i, 0, 0.1 * level})
        sim.setObjectParent(dummy, parent, true)
        if level == 1 then bases[i] = dummy end
        parent = dummy
    end
    for side = 1, 10 do
        local dummy = sim.createDummy(0.01)
        sim.setObjectPosition(dummy, {i, 0.1 * side, 1})
        sim.setObjectParent(dummy, parent, true)
        objects[#objects + 1] = dummy
    end
end
local x = 0
function sysCall_actuation()
    x = x + 0.001
    for i = 1, MOVED do sim.setObjectPosition(bases[i], {i, x, 0}) end
    for i = 1, 1000 do sim.getObjectPose(objects[i]) end
end
";
const LISTENER: &str = "function sysCall_event(events) received = (received or 0) + #events end";
const FILTERED: &str = "
sim.setEventFilters({[sim.handle_sceneobject] = {'pose'}})
function sysCall_event(events) received = (received or 0) + #events end
";

fn running(kind: ScriptKind, scene: &str) -> Simulator {
    let mut sim = Simulator::new(Options::default());
    sim.scene_mut()
        .add_default_objects()
        .expect("an empty scene has room");
    sim.add_script(kind, "bench", scene.as_bytes())
        .expect("the scene loads");
    sim.step(2);
    sim
}

fn child_scripts(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("child scripts");
    group
        .throughput(Throughput::Elements(1))
        .sampling_mode(SamplingMode::Flat)
        .sample_size(20);
    for count in [0, 1, 100, 1000] {
        let mut sim = running(
            ScriptKind::Sandbox,
            &CHILDREN.replace("COUNT", &count.to_string()),
        );
        group.bench_function(count.to_string(), |bencher| bencher.iter(|| sim.iterate()));
    }
    group.finish();
}

fn pile(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pile");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    // While they fall and come to rest nothing sleeps.
    for steps in [40, 200] {
        group.throughput(Throughput::Elements(steps));
        group.bench_function(format!("100 cuboids, {steps} steps"), |bencher| {
            bencher.iter_batched(
                || running(ScriptKind::Sandbox, PILE),
                |mut sim| sim.step(steps),
                criterion::BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

fn arm(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("arm");
    group
        .throughput(Throughput::Elements(1))
        .sampling_mode(SamplingMode::Flat)
        .sample_size(20);
    let mut sim = running(ScriptKind::Customization, ARM);
    sim.step(20);
    group.bench_function("seven joints", |bencher| bencher.iter(|| sim.iterate()));
    group.finish();
}

fn world_poses(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("1000 world poses ten levels deep");
    group
        .throughput(Throughput::Elements(1))
        .sampling_mode(SamplingMode::Flat)
        .sample_size(20);
    for (name, moved) in [("nothing moves", "0"), ("all move", "100")] {
        let mut sim = running(ScriptKind::Customization, &DEEP.replace("MOVED", moved));
        group.bench_function(name, |bencher| bencher.iter(|| sim.iterate()));
    }
    group.finish();
}

fn events(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("1000 moving objects");
    group
        .throughput(Throughput::Elements(1))
        .sampling_mode(SamplingMode::Flat)
        .sample_size(20);
    for (name, listener) in [
        ("no listener", ""),
        ("filtered listener", FILTERED),
        ("listener", LISTENER),
    ] {
        let mut sim = running(ScriptKind::Customization, &format!("{MOVING}{listener}"));
        group.bench_function(name, |bencher| bencher.iter(|| sim.iterate()));
    }
    group.finish();
}

criterion_group!(benches, child_scripts, pile, arm, events, world_poses);
criterion_main!(benches);
