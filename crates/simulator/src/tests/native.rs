//! Scripts made of functions of a program, and calls by programs.

use std::cell::RefCell;
use std::rc::Rc;

use crate::{Caller, NativeScript, Progress, ScriptKind, ScriptRef, Simulator};
use scene::Data;
use script::Options;

/// Notes what it is called, and calls the API meanwhile.
struct Robot {
    caller: Caller,
    calls: Rc<RefCell<Vec<String>>>,
}

impl NativeScript for Robot {
    fn defines(&self, function: &str) -> bool {
        [
            "sysCall_init",
            "sysCall_actuation",
            "sysCall_cleanup",
            "twice",
            "fails",
        ]
        .contains(&function)
    }

    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        let time = self.caller.function("sim.getSimulationTime");
        let time = self
            .caller
            .call(&time, &[])
            .map_err(|error| error.to_string())?;
        self.calls.borrow_mut().push(format!("{function} {time:?}"));
        match function {
            "twice" => Ok(vec![args[0].clone(), args[0].clone()]),
            "fails" => Err("a wheel is off".into()),
            _ => Ok(Vec::new()),
        }
    }
}

fn robot(simulator: &mut Simulator, kind: ScriptKind) -> (i64, Rc<RefCell<Vec<String>>>) {
    let calls = Rc::<RefCell<Vec<String>>>::default();
    let seen = Rc::clone(&calls);
    let script = simulator.add_native_script(kind, "robot", move |caller| {
        Ok(Box::new(Robot {
            caller,
            calls: Rc::clone(&seen),
        }))
    });
    (script.expect("there is room").handle(), calls)
}

#[test]
fn a_program_is_a_script() {
    let mut simulator = Simulator::new(Options::default());
    let (handle, calls) = robot(&mut simulator, ScriptKind::Simulation);
    simulator.step(2);
    let twice = [Data::text("twice"), Data::Int(handle), Data::text("x")];
    assert_eq!(
        simulator.call_api("sim.callScriptFunction", &twice),
        Ok(vec![Data::text("x"), Data::text("x")])
    );
    simulator.stop();
    let time = |name: &str, time: f64| format!("{name} [Float({time:?})]");
    assert_eq!(
        calls.borrow()[..3],
        [
            time("sysCall_init", 0.0),
            time("sysCall_actuation", 0.0),
            time("sysCall_actuation", 0.05)
        ]
    );
    assert!(
        calls
            .borrow()
            .last()
            .is_some_and(|last| last.starts_with("sysCall_cleanup"))
    );
    assert_eq!(simulator.errors(), 0);
}

#[test]
fn its_error_ends_it() {
    let mut simulator = Simulator::new(Options::default());
    let (handle, _) = robot(&mut simulator, ScriptKind::Customization);
    let fails = [Data::text("fails"), Data::Int(handle)];
    let error = simulator
        .call_api("sim.callScriptFunction", &fails)
        .expect_err("it fails");
    assert_eq!(
        (error.to_string().as_str(), simulator.errors()),
        ("error in script function.", 1)
    );
    assert!(
        simulator
            .call_api("sim.callScriptFunction", &fails)
            .is_err(),
        "it has ended"
    );
}

#[test]
fn a_call_that_waits_is_resumed_after_steps() {
    let mut simulator = Simulator::new(Options::default());
    let (handle, _) = robot(&mut simulator, ScriptKind::AddOn);
    let script = simulator.parts.sim.script(handle).expect("it is there");
    let caller = simulator.caller(&ScriptRef(script.id));
    simulator.start();
    let wait = caller.function("sim.wait");
    let mut progress = caller.begin(&wait, &[Data::Float(0.1)]);
    let mut steps = 0;
    while let Ok(Progress::Waits(number)) = progress {
        simulator.iterate();
        steps += 1;
        progress = caller.resume(number);
    }
    assert_eq!(
        (progress, steps),
        (Ok(Progress::Done(vec![Data::Float(0.0)])), 2)
    );
    assert!(
        caller.call(&wait, &[Data::Float(0.1)]).is_err(),
        "a plain call cannot wait"
    );
    assert!(caller.resume(99).is_err());
}

#[test]
fn a_caller_outlives_its_simulator() {
    let mut simulator = Simulator::new(Options::default());
    let (handle, _) = robot(&mut simulator, ScriptKind::AddOn);
    let script = simulator.parts.sim.script(handle).expect("it is there");
    let caller = simulator.caller(&ScriptRef(script.id));
    drop(simulator);
    assert!(
        caller
            .call(&caller.function("sim.getSimulationTime"), &[])
            .is_err()
    );
    assert_eq!((caller.time(), caller.steps()), (0.0, 0));
}
