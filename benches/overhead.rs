//! What the scene costs beside the engine: the same boxes on the same floor, in raw rapier and in a simulator. A pass is ten sub-steps
//! of 5 ms in both. The boxes slide without friction, so slowly that they get nowhere: else the simulator's would fall asleep. Those
//! that may sleep are measured as well.

use criterion::{Criterion, criterion_group, criterion_main};
use rapier3d_f64::prelude::*;
use swanilda::{Options, ScriptKind, Simulator};

const SUB_STEPS: usize = 10;
const HALF: f64 = 0.05;
/// Metres per second.
const SLIDING: f64 = 1e-4;

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
    sim.scene_mut().add_default_objects().expect("an empty scene has room");
    let scene = SCENE.replace("COUNT", &count.to_string()).replace("SLIDING", &sliding.to_string());
    sim.add_script(ScriptKind::Customization, "scene", scene.as_bytes()).expect("the scene loads");
    sim.step(60);
    sim
}

/// rapier alone, with the settings of `src/dynamics/world.rs`.
struct Raw {
    bodies: RigidBodySet,
    colliders: ColliderSet,
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    ccd: CCDSolver,
    pipeline: PhysicsPipeline,
    parameters: IntegrationParameters,
}

impl Raw {
    fn new(count: usize) -> Self {
        let softness = SpringCoefficients { natural_frequency: 60.0, damping_ratio: 5.0 };
        let mut raw = Self {
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            ccd: CCDSolver::new(),
            pipeline: PhysicsPipeline::new(),
            parameters: IntegrationParameters {
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
            },
        };
        raw.cuboid(RigidBodyBuilder::fixed().translation(Vector::new(0.0, 0.0, -0.1)), [2.5, 2.5, 0.1]);
        let slide = Vector::new(SLIDING, 0.0, 0.0);
        for i in 0..count {
            let at = Vector::new((i % 32) as f64 * 0.15 - 2.4, (i / 32) as f64 * 0.15 - 2.4, HALF);
            raw.cuboid(
                RigidBodyBuilder::dynamic().translation(at).linvel(slide).can_sleep(false).allow_fast_rotation(true),
                [HALF; 3],
            );
        }
        raw.pass();
        raw
    }

    fn cuboid(&mut self, body: RigidBodyBuilder, [x, y, z]: [f64; 3]) {
        let body = self.bodies.insert(body);
        let collider = ColliderBuilder::cuboid(x, y, z).mass(1.0).friction(0.0);
        self.colliders.insert_with_parent(collider, body, &mut self.bodies);
    }

    fn pass(&mut self) {
        for _ in 0..SUB_STEPS {
            self.pipeline.step(
                Vector::new(0.0, 0.0, -9.81),
                &self.parameters,
                &mut self.islands,
                &mut self.broad_phase,
                &mut self.narrow_phase,
                &mut self.bodies,
                &mut self.colliders,
                &mut self.joints,
                &mut self.multibodies,
                &mut self.soft_bodies,
                &mut self.ccd,
                &(),
                &(),
            );
        }
    }
}

fn overhead(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("overhead");
    group.sample_size(20);
    for count in [100, 1000] {
        let (mut raw, mut sim) = (Raw::new(count), simulator(count, SLIDING));
        group.bench_function(format!("raw rapier, {count} boxes"), |bencher| bencher.iter(|| raw.pass()));
        group.bench_function(format!("simulator, {count} boxes"), |bencher| bencher.iter(|| sim.pass()));
    }
    let mut sim = simulator(1000, 0.0);
    group.bench_function("simulator, 1000 sleeping boxes", |bencher| bencher.iter(|| sim.pass()));
    group.finish();
}

criterion_group!(benches, overhead);
criterion_main!(benches);
