//! Scripts in a second language, made of Rust functions: the host knows no language, and scripts of two languages work together.

use std::cell::{Cell, OnceCell, RefCell};
use std::rc::{Rc, Weak};
use std::sync::atomic::Ordering;

use crate::memory::Parts;
use crate::{ScriptRef, Simulator};
use heap::Contained;
use scene::object::script_object::{ScriptObject, ScriptType};
use scene::{Data, Kind};
use script::{
    CallError, CallbackResult, Callee, Console, Env, FunctionRef, Handler, HeldFunction, Hook,
    Interpreter, Language, Languages, Limits, LogLine, LuaLanguage, Options, Runtime, ScriptError,
    Sim, SourceText, SysCall,
};

type Lines = Rc<RefCell<Vec<String>>>;
type Outcome = Result<Vec<Data>, ScriptError>;
/// A function of a script.
type Function = fn(&Running, &[Data]) -> Outcome;

/// The text `robot` in the second language.
const ROBOT: &[(&str, Function)] = &[
    ("sysCall_init", |robot, _| robot.note("init")),
    ("sysCall_actuation", |robot, _| robot.note("actuation")),
    ("sysCall_thread", |robot, _| robot.note("thread")),
    ("sysCall_cleanup", |robot, _| robot.note("cleanup")),
    ("before", |robot, _| robot.note("hook")),
    ("position", |robot, args| {
        robot.api("sim.getObjectPosition", args)
    }),
    ("twice_the_half", |robot, args| {
        let lua = robot.api("sim.getObject", &[Data::text("/lua")])?;
        let half = robot.api(
            "sim.callScriptFunction",
            &[Data::text("half"), lua[0].clone(), args[0].clone()],
        )?;
        Ok(vec![half[0].clone(), half[0].clone()])
    }),
    ("fail", |_, _| {
        Err(error("robot:3: out of order\nwhile calling fail"))
    }),
    ("wait_for_ever", |robot, _| robot.wait_for_ever()),
];

/// The text `broken`: its actuation fails.
const BROKEN: &[(&str, Function)] = &[
    ("sysCall_init", |_, _| Ok(Vec::new())),
    ("sysCall_actuation", |_, _| {
        Err(error("broken:1: a wheel is off"))
    }),
    ("sysCall_cleanup", |broken, _| broken.note("cleanup")),
];

fn error(text: &str) -> ScriptError {
    ScriptError::new(text)
}

/// State that the language shares with its scripts.
#[derive(Default)]
struct Shared {
    /// Actions of scripts.
    lines: RefCell<Vec<String>>,
    sim: OnceCell<Weak<Sim>>,
}

struct RustLanguage(Rc<Shared>);

impl Language for RustLanguage {
    fn name(&self) -> &'static str {
        "rust"
    }

    fn create(&self, env: Rc<Env>) -> Rc<Runtime> {
        let interpreter = Running {
            env: Rc::clone(&env),
            functions: Cell::new(&[]),
            lua: OnceCell::new(),
            shared: Rc::clone(&self.0),
        };
        Runtime::new(env, interpreter)
    }
}

/// A running script.
struct Running {
    env: Rc<Env>,
    functions: Cell<&'static [(&'static str, Function)]>,
    /// Runs the functions of the library that are written in Lua.
    lua: OnceCell<Rc<Runtime>>,
    shared: Rc<Shared>,
}

impl Running {
    fn note(&self, line: &str) -> Outcome {
        self.shared.lines.borrow_mut().push(line.to_owned());
        Ok(Vec::new())
    }

    fn sim(&self) -> Result<Rc<Sim>, ScriptError> {
        self.shared
            .sim
            .get()
            .and_then(Weak::upgrade)
            .ok_or_else(|| error("the simulator is gone"))
    }

    /// Calls an API function with plain values.
    fn api(&self, name: &str, args: &[Data]) -> Outcome {
        self.sim()?
            .call_api(&self.env.script, name, args)
            .map_err(|reason| error(&reason.to_string()))
    }

    fn lua(&self) -> Result<&Runtime, ScriptError> {
        if self.lua.get().is_none() {
            let lua = self.sim()?.create_runtime(&self.env.script, "lua")?;
            lua.interpreter.start()?;
            let _ = self.lua.set(lua);
        }
        self.lua
            .get()
            .map(Rc::as_ref)
            .ok_or_else(|| error("the interpreter was just set"))
    }

    fn wait_for_ever(&self) -> Outcome {
        for turn in 0..1000 {
            if let Some(text) = self.env.interruption(|| self.traceback()) {
                return Err(error(&format!("{text} in turn {turn}")));
            }
            if turn == 10 {
                self.sim()?.options.stop.store(true, Ordering::Relaxed);
            }
        }
        self.note("never interrupted")
    }

    fn find(&self, name: &str) -> Option<Function> {
        self.functions
            .get()
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, function)| *function)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.shared.lines.borrow_mut().push("closed".into());
    }
}

impl Interpreter for Running {
    fn start(&self) -> Result<(), ScriptError> {
        self.note("start").map(drop)
    }

    fn load(&self, source: &SourceText<'_>) -> Result<(), ScriptError> {
        self.functions.set(match source.text {
            b"robot" => ROBOT,
            b"broken" => BROKEN,
            _ => return Err(error(&format!("{}: unknown text", source.chunk_name))),
        });
        Ok(())
    }

    fn defines(&self, call: SysCall) -> bool {
        self.find(call.name()).is_some()
    }

    fn call_callback(&self, call: SysCall, args: &[Data]) -> Result<CallbackResult, ScriptError> {
        match self.find(call.name()) {
            Some(function) => Ok(CallbackResult::Returned(function(self, args)?.pop())),
            None => Ok(CallbackResult::NotDefined),
        }
    }

    fn call_hook(&self, hook: &Hook, args: &[Data]) -> Result<bool, ScriptError> {
        match self.find(&hook.name) {
            Some(function) => function(self, args).map(|_| true),
            None => Ok(false),
        }
    }

    fn resume_thread(&self) -> Result<(), ScriptError> {
        match self.find("sysCall_thread") {
            Some(thread) => thread(self, &[]).map(drop),
            None => Ok(()),
        }
    }

    fn call(&self, function: Callee<'_>, args: &[Data]) -> Result<Vec<Data>, CallError> {
        let function = match function {
            Callee::Named(name) => self.find(name),
            Callee::Function(function) => self
                .functions
                .get()
                .get(function.number() as usize)
                .map(|entry| entry.1),
        };
        Ok(function.ok_or(CallError::NoSuchFunction)?(self, args)?)
    }

    fn run(&self, _: &[u8], _: &str) -> Result<(), ScriptError> {
        Err(error("one text is enough"))
    }

    fn evaluate(&self, text: &[u8]) -> Outcome {
        Ok(vec![Data::Int(text.len() as i64)])
    }

    fn call_library(&self, module: &str, function: &str, args: &[Data]) -> Outcome {
        self.lua()?.interpreter.call_library(module, function, args)
    }

    fn release(&self, function: FunctionRef) {
        self.shared
            .lines
            .borrow_mut()
            .push(format!("released {}", function.number()));
    }

    fn traceback(&self) -> String {
        "in robot".into()
    }
}

/// Keeps log lines of errors.
struct Errors(Lines);

impl Console for Errors {
    fn print(&mut self, _: &[u8], _: f64) {}

    fn log(&mut self, line: &LogLine<'_>) {
        if line.decorated().contains(":error]") {
            self.0.borrow_mut().push(line.decorated());
        }
    }
}

struct Fixture {
    simulator: Simulator,
    shared: Rc<Shared>,
    errors: Lines,
}

impl Fixture {
    fn new(options: Options) -> Self {
        let (shared, errors) = (Rc::new(Shared::default()), Lines::default());
        let languages: Vec<Box<dyn Language>> = vec![
            Box::new(LuaLanguage::new(Vec::new())),
            Box::new(RustLanguage(Rc::clone(&shared))),
        ];
        let console = Box::new(Errors(Rc::clone(&errors)));
        let sim = Sim::new(
            options.clone(),
            modules::registry(),
            console,
            Languages::new(languages),
        );
        let _ = shared.sim.set(Rc::downgrade(&sim));
        let parts = Contained::new(|| Parts {
            sim,
            native_scripts: Rc::default(),
        });
        Self {
            simulator: Simulator::with_main_and_sandbox(parts, options),
            shared,
            errors,
        }
    }

    fn add(&mut self, alias: &str, language: &str, text: &str) -> ScriptRef {
        let mut object = ScriptObject::new(ScriptType::Simulation, text.into(), language, false);
        object.disabled = false;
        let object = Kind::Script(Box::new(object));
        let handle = self
            .simulator
            .scene_mut()
            .add(alias, object)
            .expect("there is room");
        self.simulator.script(handle).expect("it is a script")
    }

    /// Actions of scripts in the second language since the last call.
    fn take_lines(&self) -> Vec<String> {
        self.shared.lines.take()
    }
}

const LUA: &str = "
    sim = require 'sim'
    function sysCall_init() robot = sim.getObject '/robot' end
    function half(x) return x / 2 end
    function ask(name, ...) return sim.callScriptFunction(name, robot, ...) end
    function try(name, ...) return pcall(ask, name, ...) end
    function length(text) return sim.executeScriptString(text, robot) end
    function trace() return sim.getStackTraceback(robot) end";

#[test]
fn a_script_lives_in_any_language() {
    let mut fixture = Fixture::new(Options::default());
    fixture.add("robot", "rust", "robot");
    fixture.simulator.step(2);
    assert_eq!(
        fixture.take_lines(),
        [
            "start",
            "init",
            "thread",
            "actuation",
            "thread",
            "actuation"
        ]
    );
    fixture.simulator.stop();
    let lines = fixture.take_lines();
    assert_eq!(lines[lines.len() - 2..], ["cleanup", "closed"]);
    assert_eq!(fixture.simulator.errors(), 0);
}

#[test]
fn scripts_call_each_other_across_languages() {
    let mut fixture = Fixture::new(Options::default());
    fixture.add("robot", "rust", "robot");
    let lua = fixture.add("lua", "lua", LUA);
    fixture.simulator.step(1);
    let errors = Rc::clone(&fixture.errors);
    let mut ask = |function: &str, args: &[Data]| {
        fixture
            .simulator
            .call(&lua, function, args)
            .unwrap_or_else(|_| panic!("{:?}", errors.borrow()))
    };
    let position = [Data::text("position"), Data::Int(lua.handle())];
    assert_eq!(
        ask("ask", &position),
        [Data::Array(vec![Data::Float(0.0); 3])]
    );
    assert_eq!(
        ask("ask", &[Data::text("twice_the_half"), Data::Int(5)]),
        [Data::Float(2.5), Data::Float(2.5)]
    );
    assert_eq!(
        ask("length", &[Data::text("1234")]),
        [Data::Int(0), Data::Int(4)]
    );
    assert_eq!(ask("trace", &[]), [Data::text("in robot")]);
    let [Data::Bool(false), Data::Text(reason)] = &ask("try", &[Data::text("nothing")])[..] else {
        panic!("called")
    };
    assert!(String::from_utf8_lossy(reason).ends_with("failed calling script function."));
    assert_eq!(fixture.simulator.errors(), 0);
}

#[test]
fn the_error_of_a_function_ends_its_script_and_reaches_the_caller() {
    let mut fixture = Fixture::new(Options::default());
    fixture.add("robot", "rust", "robot");
    let lua = fixture.add("lua", "lua", LUA);
    fixture.simulator.step(1);
    fixture.take_lines();
    let caught = fixture
        .simulator
        .call(&lua, "try", &[Data::text("fail")])
        .expect("pcall catches it");
    let [Data::Bool(false), Data::Text(reason)] = &caught[..] else {
        panic!("{caught:?}")
    };
    assert!(String::from_utf8_lossy(reason).ends_with("error in script function."));
    assert_eq!(fixture.take_lines(), ["cleanup", "closed"]);
    let logged = "[/robot:error]   robot:3: out of order\nwhile calling fail";
    assert_eq!(*fixture.errors.borrow(), [logged]);
}

#[test]
fn the_error_of_a_callback_ends_its_script() {
    let mut fixture = Fixture::new(Options::default());
    fixture.add("robot", "rust", "broken");
    fixture.simulator.step(2);
    assert_eq!(fixture.take_lines(), ["start", "cleanup", "closed"]);
    assert_eq!(
        *fixture.errors.borrow(),
        ["[/robot:error]   broken:1: a wheel is off"]
    );
}

#[test]
fn a_text_that_does_not_load_is_an_error() {
    let mut fixture = Fixture::new(Options::default());
    fixture.add("robot", "rust", "else");
    fixture.simulator.step(1);
    assert_eq!(fixture.take_lines(), ["start", "closed"]);
    assert_eq!(
        *fixture.errors.borrow(),
        ["[/robot:error]   /robot: unknown text"]
    );
}

#[test]
fn a_language_that_is_not_there_is_an_error() {
    let mut fixture = Fixture::new(Options::default());
    fixture.add("robot", "python", "#python\nprint(1)");
    fixture.simulator.step(2);
    let error = "[/robot:error]   scripts in Python are not implemented in Swanilda.";
    assert_eq!(*fixture.errors.borrow(), [error]);
}

#[test]
fn a_script_that_never_returns_is_interrupted() {
    let limits = Some(Limits { memory: usize::MAX });
    let mut fixture = Fixture::new(Options {
        limits,
        ..Options::default()
    });
    let robot = fixture.add("robot", "rust", "robot");
    fixture.simulator.step(1);
    fixture
        .simulator
        .call(&robot, "wait_for_ever", &[])
        .expect_err("it is interrupted");
    assert_eq!(
        *fixture.errors.borrow(),
        ["[/robot:error]   interrupted. in turn 11"]
    );
}

#[test]
fn hooks_run_and_functions_are_released() {
    let mut fixture = Fixture::new(Options::default());
    let robot = fixture.add("robot", "rust", "robot");
    fixture.simulator.step(1);
    fixture.take_lines();
    let sim = Rc::clone(&fixture.simulator.parts.sim);
    let script = fixture.simulator.found(robot.handle());
    let script = script.expect("it is there");
    let hook = [
        Data::text("sysCall_actuation"),
        Data::text("before"),
        Data::Bool(true),
    ];
    sim.call_api(&script, "registerScriptFuncHook", &hook)
        .expect("it is registered");
    fixture.simulator.step(1);
    assert_eq!(fixture.take_lines(), ["thread", "hook", "actuation"]);

    let function = HeldFunction::new(
        &script.current_runtime().expect("it runs").env,
        FunctionRef::new(1),
    );
    let handler = Handler::Function(function);
    assert_eq!(sim.call_handler(&script, &handler, &[]), Some(Vec::new()));
    drop(handler);
    assert_eq!(fixture.take_lines(), ["actuation", "released 1"]);
}
