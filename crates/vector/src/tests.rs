//! Tests of worlds.

mod episodes;
mod errors;

use crate::{Declaration, Quantity, Reset, Vector};
use script::Options;

#[global_allocator]
static ALLOCATOR: heap::Allocator = heap::Allocator;

/// A ball that falls, pushed by the script, which draws random numbers.
const SCENE: &str = "
sim = require 'sim'
function sysCall_init()
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(ball, 'ball')
    sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(ball, sim.shapeintparam_respondable, 1)
    sim.setObjectPosition(ball, {0, 0, 0.5})
    push = 0
    n = 0
end
function push_by(x) push = x end
function sysCall_actuation()
    sim.addForceAndTorque(ball, {push + 0.01 * math.random(), 0.01 * sim.getRandom(), 0})
end
function sysCall_sensing()
    n = n + 1
    if push == 13 then error('thirteen') end
end
";

/// A file with the scene, and what is declared of it.
fn declared(code: &str) -> (tempfile::TempDir, Declaration) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = folder.path().join("scene.lua");
    std::fs::write(&scene, code).expect("the folder is writable");
    let options = Options {
        render_threads: std::num::NonZero::new(1),
        ..Options::default()
    };
    let declaration = Declaration {
        observations: vec![
            Quantity::Position("/ball".into()),
            Quantity::Velocity("/ball".into()),
        ],
        actions: vec![crate::Action::Function("/Script".into(), "push_by".into())],
        reset: Reset::Snapshot,
        ..Declaration::new(scene, options)
    };
    (folder, declaration)
}

fn vector(declaration: &Declaration, count: usize, threads: usize) -> Vector {
    let made = Vector::new(declaration.clone(), count, threads, Box::new(|| false));
    made.unwrap_or_else(|failure| panic!("{failure}"))
}

fn seeds(count: usize, first: u32) -> Vec<(usize, Option<u32>)> {
    (0..count)
        .zip(first..)
        .map(|(world, seed)| (world, Some(seed)))
        .collect()
}

/// Steps all worlds with one action for each, and returns the observations as bits.
fn step(vector: &mut Vector, actions: &[f64]) -> Vec<Vec<u64>> {
    let arrays = std::sync::Arc::clone(vector.arrays());
    for (world, action) in actions.iter().enumerate() {
        arrays.actions.set(world, *action);
    }
    let failures = vector.step();
    assert_eq!(failures, Ok(Vec::new()));
    (0..vector.count())
        .map(|world| bits(vector, world))
        .collect()
}

fn bits(vector: &Vector, world: usize) -> Vec<u64> {
    let observed = vector.arrays().observations.read(world);
    observed.into_iter().map(f64::to_bits).collect()
}
