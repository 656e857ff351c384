//! A simulator inside a Rust program: load a scene, step it, read a pose, call a function of its script.
//!
//! `cargo run --example embed`

use swanilda::scene::{Data, Handle};
use swanilda::{Error, Options, ScriptKind, Simulator};

const SCENE: &str = "
sim = require 'sim'

function sysCall_init()
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2})
    sim.setObjectPosition(ball, {0, 0, 2})
    sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
end

function push(speed)
    sim.addForceAndTorque(ball, {speed * sim.getShapeMass(ball) / sim.getSimulationTimeStep(), 0, 0})
    return ball
end
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Scripts may recurse deeply: give them the stack they expect.
    let thread = std::thread::Builder::new().stack_size(Simulator::STACK_SIZE);
    thread
        .spawn(simulate)?
        .join()
        .expect("a simulator does not panic")?;
    Ok(())
}

fn simulate() -> Result<(), Error> {
    let mut sim = Simulator::new(Options::default());
    let script = sim.add_script(ScriptKind::Customization, "embedded", SCENE.as_bytes())?;
    sim.step(1);
    let results = sim.call(&script, "push", &[Data::Float(1.5)])?;
    let [Data::Int(ball)] = results.as_slice() else {
        panic!("push returns a handle")
    };
    let ball = Handle::from_raw(*ball).expect("push returns a handle");
    for _ in 0..5 {
        sim.step(2);
        if let Ok(pose) = sim.scene().world_pose(ball) {
            println!(
                "{:.2} s: the ball is at {:.3?}",
                sim.time(),
                pose.translation.vector.as_slice()
            );
        }
    }
    sim.stop();
    Ok(())
}
