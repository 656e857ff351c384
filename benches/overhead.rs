//! What the scene costs beside the engine: the same boxes on the same floor, in raw rapier and in a simulator. An iteration is ten sub-steps
//! of 5 ms in both. The boxes slide without friction, so slowly that they get nowhere: else the simulator's would fall asleep. Those
//! that may sleep are measured as well.

mod common;

use common::RawWorld;
use criterion::{Criterion, criterion_group, criterion_main};
use rapier3d_f64::prelude::*;
use swanilda::{Options, ScriptKind, Simulator};

const SUB_STEPS: usize = 10;
const HALF: f64 = 0.05;
/// Metres per second.
const SLIDING: f64 = 1e-4;
/// Bodies that move more slowly may sleep, metres or radians per second; as in the simulator.
const RESTING: f64 = 1e-5;

const SCENE: &str = "
sim = require 'sim'
for i = 0, COUNT - 1 do
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(box, {i % 32 * 0.15 - 2.4, i // 32 * 0.15 - 2.4, 0.05})
    sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(box, sim.shapeintparam_respondable, 1)
    sim.setShapeMass(box, 1)
    if SLIDING > 0 then
        sim.setEngineFloatParam(sim.bullet_body_oldfriction, box, 0)
        sim.setObjectFloatParam(box, sim.shapefloatparam_init_velocity_x, SLIDING)
    end
end
";

fn simulator(count: usize, sliding: f64) -> Simulator {
    let mut sim = Simulator::new(Options::default());
    sim.scene_mut()
        .add_default_objects()
        .expect("an empty scene has room");
    let scene = SCENE
        .replace("COUNT", &count.to_string())
        .replace("SLIDING", &sliding.to_string());
    sim.add_script(ScriptKind::Customization, "scene", scene.as_bytes())
        .expect("the scene loads");
    sim.step(60);
    sim
}

/// The settings of `crates/dynamics/src/world.rs`.
fn parameters() -> IntegrationParameters {
    let softness = SpringCoefficients {
        natural_frequency: 60.0,
        damping_ratio: 5.0,
    };
    IntegrationParameters {
        dt: 0.005,
        num_solver_iterations: 1,
        num_internal_pgs_iterations: 4,
        normalized_allowed_linear_error: 2e-4,
        normalized_prediction_distance: 0.01,
        normalized_max_linear_velocity: f64::MAX,
        contact_softness: softness,
        static_contact_softness: softness,
        friction_model: FrictionModel::Simplified,
        ..IntegrationParameters::default()
    }
}

fn raw_rapier(count: usize) -> RawWorld {
    let cuboid = |x, y, z| ColliderBuilder::cuboid(x, y, z).mass(1.0).friction(0.0);
    let mut raw = RawWorld::new(parameters());
    raw.add(
        RigidBodyBuilder::fixed().translation(Vector::new(0.0, 0.0, -0.1)),
        cuboid(2.5, 2.5, 0.1),
    );
    for i in 0..count {
        let at = Vector::new(
            (i % 32) as f64 * 0.15 - 2.4,
            (i / 32) as f64 * 0.15 - 2.4,
            HALF,
        );
        let body = RigidBodyBuilder::dynamic()
            .translation(at)
            .linvel(Vector::new(SLIDING, 0.0, 0.0));
        let body = raw.add(body.allow_fast_rotation(true), cuboid(HALF, HALF, HALF));
        let activation = raw.bodies[body].activation_mut();
        (
            activation.normalized_linear_threshold,
            activation.angular_threshold,
        ) = (RESTING, RESTING);
    }
    iterate(&mut raw);
    raw
}

fn iterate(raw: &mut RawWorld) {
    (0..SUB_STEPS).for_each(|_| raw.step());
}

fn overhead(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("overhead");
    group.sample_size(20);
    for count in [100, 1000] {
        let (mut raw, mut sim) = (raw_rapier(count), simulator(count, SLIDING));
        group.bench_function(format!("raw rapier, {count} boxes"), |bencher| {
            bencher.iter(|| iterate(&mut raw));
        });
        group.bench_function(format!("simulator, {count} boxes"), |bencher| {
            bencher.iter(|| sim.iterate());
        });
    }
    let mut sim = simulator(1000, 0.0);
    group.bench_function("simulator, 1000 sleeping boxes", |bencher| {
        bencher.iter(|| sim.iterate());
    });
    group.finish();
}

criterion_group!(benches, overhead);
criterion_main!(benches);
