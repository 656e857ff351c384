//! The seed of a simulator that runs.

use scene::Data;

use crate::{Options, ScriptKind, Simulator};

const SCRIPT: &[u8] = b"
sim = require 'sim'
function numbers()
    return math.random(), sim.getRandom(), sim.getFloatProperty(sim.handle_app, 'randomFloat')
end
";

fn numbers(simulator: &mut Simulator) -> Vec<Data> {
    let script = simulator.add_script(ScriptKind::Customization, "", SCRIPT);
    let script = script.expect("the script loads");
    let drawn = simulator.call(&script, "numbers", &[]);
    drawn.expect("they are drawn")
}

#[test]
fn random_numbers_begin_again_for_scripts_that_run_and_those_to_come() {
    let of_seed = |seed| {
        Simulator::new(Options {
            seed,
            ..Options::default()
        })
    };
    let (first, second) = (numbers(&mut of_seed(5)), numbers(&mut of_seed(6)));
    assert!(first.iter().zip(&second).all(|(a, b)| a != b), "{first:?}");

    let mut simulator = of_seed(5);
    let running = simulator.add_script(ScriptKind::Customization, "", SCRIPT);
    let running = running.expect("the script loads");
    let drawn = simulator.call(&running, "numbers", &[]);
    assert_eq!(drawn, Ok(first.clone()));
    simulator
        .set_seed(6)
        .expect("the script has Lua's generator");
    let drawn = simulator.call(&running, "numbers", &[]);
    assert_eq!(drawn, Ok(second.clone()));
    simulator
        .set_seed(5)
        .expect("the script has Lua's generator");
    assert_eq!(numbers(&mut simulator), first);
}
