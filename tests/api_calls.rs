//! Every function answers the same, whether a script calls it or `Simulator::call_api` does. A program of its own, since the folder it works in
//! is that of the whole process.

use swanilda::scene::{Data, Key};
use swanilda::{Options, ScriptKind, ScriptRef, Simulator};

/// These end the program, wait for somebody, or choose that errors are not raised.
const NOT_CALLED: &[&str] = &[
    "quitSimulator",
    "sim.quitSimulator",
    "sim.wait",
    "sim.systemSemaphore",
    "sim.setInt32Param",
];

/// Their answers differ from call to call, or they look at who is calling.
const OTHER_ANSWERS: &[&str] = &[
    "sim.getSystemTime",
    "sim.getSystemTimeInMs",
    "sim.getLastError",
    "simGetSystemTimeInMilliseconds",
    "sim.getStackTraceback",
    "sim.executeScriptString",
    "sim.callScriptFunction",
    "sim.getGenesisEvents",
    "setYieldAllowed",
    "getYieldAllowed",
];

/// What a script needs to be called by name: whether it worked, and the results or the error.
const CALLER: &str = "
    function call(name, ...)
        local f = _G
        for part in name:gmatch('[^.]+') do f = f[part] end
        return pcall(f, ...)
    end";

/// A simulator with a joint, a shape and a dummy.
struct Fixture {
    sim: Simulator,
    script: ScriptRef,
}

impl Fixture {
    fn new() -> Self {
        let mut sim = Simulator::new(Options::default());
        let code = "sim = require 'sim' sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
            sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3}) sim.createDummy(0.1)";
        let script = sim
            .add_script(
                ScriptKind::Sandbox,
                "prepare",
                [code, CALLER].concat().as_bytes(),
            )
            .expect("the sandbox takes the chunk");
        Self { sim, script }
    }

    fn by_script(&mut self, name: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        let all: Vec<Data> = std::iter::once(Data::text(name))
            .chain(args.iter().cloned())
            .collect();
        let mut results = self
            .sim
            .call(&self.script, "call", &all)
            .expect("pcall catches errors")
            .into_iter();
        match results.next() {
            Some(Data::Bool(true)) => Ok(results.collect()),
            _ => Err(reason(name, results.next())),
        }
    }

    fn by_values(&mut self, name: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        self.sim
            .call_api(name, args)
            .map_err(|error| error.to_string())
    }
}

/// An error without the place and the name of the function.
fn reason(name: &str, error: Option<Data>) -> String {
    let Some(Data::Text(text)) = error else {
        return String::new();
    };
    let text = String::from_utf8_lossy(&text).into_owned();
    let place = format!(": in {name}: ");
    match text.split_once(&place) {
        Some((_, reason)) => reason.to_owned(),
        None => text
            .split_once(": ")
            .map_or(text.clone(), |(_, reason)| reason.to_owned()),
    }
}

fn argument_lists(objects: &[i64]) -> Vec<Vec<Data>> {
    let numbers = |n: usize| Data::Array((0..n).map(|i| Data::Float(i as f64 * 0.25)).collect());
    let mut lists = vec![
        vec![],
        vec![Data::text("text")],
        vec![Data::text("0.5"), Data::text("2")],
        vec![numbers(3)],
    ];
    lists.extend([
        vec![numbers(12), numbers(12)],
        vec![numbers(7), numbers(7)],
        vec![numbers(3), numbers(3), Data::Float(0.5)],
    ]);
    for &object in objects {
        let object = Data::Int(object);
        lists.push(vec![object.clone()]);
        lists.push(vec![object.clone(), Data::Int(-1)]);
        lists.push(vec![object.clone(), Data::Int(-1), numbers(3)]);
        lists.push(vec![object.clone(), numbers(3)]);
        lists.push(vec![object.clone(), Data::Float(0.5)]);
        lists.push(vec![object.clone(), Data::text("alias"), Data::Bool(true)]);
        lists.push(vec![
            Data::Array(vec![object]),
            numbers(4),
            Data::Map(Vec::new()),
        ]);
    }
    lists
}

/// The fields of a table that went through Lua come in any order, NaN differs from itself, and nils at the end are nothing.
fn text(results: &[Data]) -> Vec<String> {
    let count = results
        .iter()
        .rposition(|result| *result != Data::Nil)
        .map_or(0, |last| last + 1);
    results[..count]
        .iter()
        .map(|result| {
            if let Data::Map(entries) = result {
                fields(entries)
            } else {
                format!("{result:?}")
            }
        })
        .collect()
}

fn fields(entries: &[(Key, Data)]) -> String {
    let mut fields: Vec<String> = entries
        .iter()
        .map(|(key, value)| format!("{key:?}: {:?}", text(std::slice::from_ref(value))))
        .collect();
    fields.sort_unstable();
    fields.join(", ")
}

/// The answers of both ways to make one call; None where they agree.
fn difference(
    first: &mut Fixture,
    second: &mut Fixture,
    name: &str,
    args: &[Data],
) -> Option<String> {
    let (script, values) = (first.by_script(name, args), second.by_values(name, args));
    let agree = match (&script, &values) {
        (Ok(script), Ok(values)) => text(script) == text(values),
        (Err(script), Err(values)) => script == values || script.starts_with("bad argument"),
        (_, Err(values)) => values.contains("can only be called by a Lua script"),
        _ => false,
    };
    (!agree).then(|| format!("{name}({args:?})\n  script: {script:?}\n  values: {values:?}"))
}

#[test]
fn both_doors_give_the_same_answers() {
    // Functions that write files do so where nobody minds.
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    std::env::set_current_dir(folder.path()).expect("our own folder exists");
    let known: Vec<String> = docs::native_functions().map(str::to_owned).collect();
    let names = known
        .iter()
        .filter(|name| !NOT_CALLED.contains(&&***name) && !OTHER_ANSWERS.contains(&&***name));
    let names: Vec<&String> = names.collect();
    assert!(
        names.len() > 300,
        "the functions of sim are read: {}",
        names.len()
    );
    // One after the other: some read what others have written.
    let differences = names.chunks(60).map(|chunk| {
        let (mut first, mut second) = (Fixture::new(), Fixture::new());
        let objects: Vec<i64> = first
            .sim
            .scene()
            .objects()
            .map(|object| object.handle().raw())
            .collect();
        let mut differences = Vec::new();
        for name in chunk {
            for args in argument_lists(&objects) {
                differences.extend(difference(&mut first, &mut second, name, &args));
            }
        }
        differences
    });
    let differences: Vec<String> = differences.flatten().collect();
    assert!(
        differences.is_empty(),
        "{} differences:\n{}",
        differences.len(),
        differences.join("\n")
    );
}

#[test]
fn functions_are_called_from_rust() {
    let mut fixture = Fixture::new();
    let dummy = fixture
        .sim
        .call_api("sim.createDummy", &[Data::Float(0.1)])
        .expect("there is room")
        .remove(0);
    let place = Data::Array(vec![Data::Float(1.0), Data::Float(2.0), Data::Float(3.0)]);
    assert_eq!(
        fixture
            .sim
            .call_api("sim.setObjectPosition", &[dummy.clone(), place.clone()]),
        Ok(vec![])
    );
    assert_eq!(
        fixture
            .sim
            .call_api("sim.getObjectPosition", std::slice::from_ref(&dummy)),
        Ok(vec![place])
    );
    assert_eq!(
        fixture.sim.call_api("sim.isHandle", &[dummy]),
        Ok(vec![Data::Bool(true)])
    );
    let refused = fixture
        .sim
        .call_api("sim.getObjectPosition", &[Data::text("x")])
        .expect_err("no handle");
    assert_eq!(refused.to_string(), "argument 1 is not a number.");
    let missing = fixture
        .sim
        .call_api("sim.getThreadId", &[])
        .expect_err("it is not built");
    assert_eq!(
        missing.to_string(),
        "not implemented in Swanilda: sim.getThreadId"
    );
    let needs_lua = fixture
        .sim
        .call_api("setAutoYield", &[Data::Bool(false)])
        .expect_err("there is no coroutine");
    assert_eq!(needs_lua.to_string(), "can only be called by a Lua script.");
    assert!(fixture.sim.call_api("sim.noSuchFunction", &[]).is_err());
}

#[test]
fn functions_of_other_modules_and_those_in_lua_are_called_from_rust() {
    let mut fixture = Fixture::new();
    assert_eq!(
        fixture
            .sim
            .call_api("simZMQ.z85_encode", &[Data::text("\u{1}\u{2}\u{3}\u{4}")])
            .map(|r| r.len()),
        Ok(1)
    );
    let distance = [
        Data::Array(vec![0.0.into(), 0.0.into()]),
        Data::Array(vec![3.0.into(), 4.0.into()]),
    ];
    assert_eq!(
        fixture.sim.call_api("sim.getConfigDistance", &distance),
        Ok(vec![Data::Float(5.0)])
    );
}
