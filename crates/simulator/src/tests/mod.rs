//! What the simulator as a value does.

mod journal;
mod language;
mod native;
mod seed;
mod state_hash;
mod usual_main;

use super::*;

#[test]
fn a_run_that_is_about_to_pause_ends() {
    for steps in 0..6 {
        let mut sim = Simulator::new(Options::default());
        sim.step(2);
        sim.pause();
        (0..steps).for_each(|_| sim.iterate());
        sim.stop();
        assert_eq!(sim.state(), SimulationState::Stopped);
    }
}

#[test]
fn a_simulator_goes_with_all_its_states() {
    let mut sim = Simulator::new(Options::default());
    let code = b"function sysCall_init() self = 1 end";
    let script = sim
        .add_script(ScriptKind::Customization, "script", code)
        .expect("the script loads");
    let gone = Rc::downgrade(&sim.found(script.0).expect("it is there"));
    drop(sim);
    assert!(gone.upgrade().is_none());
}
