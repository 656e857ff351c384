//! Scripts whose functions belong to the embedding program.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::caller::Link;
use super::{Caller, Error, ScriptKind, ScriptRef, Simulator};
use heap::resource::Resource;
use heap::{Outer, brought_in};
use scene::object::script_object::{ScriptObject, ScriptType};
use scene::{Data, Kind};
use script::{
    ApiError, CallError, CallbackResult, Callee, Detached, Env, FunctionRef, Hook, Interpreter,
    Language, Runtime, ScriptError, SourceText, SysCall,
};

/// The property `language` of these scripts.
pub(super) const LANGUAGE: &str = "native";

/// A running script of the embedding program. It is dropped when the script ends.
pub trait NativeScript {
    /// Whether it has a function of that name now, such as `sysCall_actuation`.
    fn defines(&self, function: &str) -> bool;

    /// Calls a function that it defines.
    ///
    /// # Errors
    /// The text of an error, which ends the script: it is logged under the script's name.
    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String>;

    /// Resumes its thread: before each actuation, and in each loop iteration outside of the simulation.
    ///
    /// # Errors
    /// As `call`.
    fn resume_thread(&self) -> Result<(), String> {
        Ok(())
    }

    /// The values of an expression.
    ///
    /// # Errors
    /// When there are no expressions, or that of the expression.
    fn evaluate(&self, text: &[u8]) -> Result<Vec<Data>, String> {
        let _ = text;
        Err("scripts of the embedding program have no text to run.".to_owned())
    }

    /// Whether it has no variables of its own, so that a snapshot of the simulator leaves out nothing of it.
    fn is_stateless(&self) -> bool {
        false
    }

    /// The calls in progress.
    fn traceback(&self) -> String {
        String::new()
    }
}

/// Makes a script each time it starts. The caller has the API in the name of that script.
pub type NativeScriptFactory = dyn Fn(Caller) -> Result<Box<dyn NativeScript>, String>;

/// What the program gave to make a script.
type Factory = Outer<Rc<NativeScriptFactory>>;

/// The scripts of a simulator, by the text of their script objects.
#[derive(Default)]
pub(super) struct NativeScripts {
    factories: RefCell<BTreeMap<Vec<u8>, Rc<Factory>>>,
    count: Cell<usize>,
    /// For the calls of scripts.
    link: OnceCell<Outer<Link>>,
}

impl NativeScripts {
    /// What calls its functions lead to.
    pub(super) fn link_to(&self, link: &Link) {
        // It is made once.
        let _ = self.link.set(Outer::new(Rc::clone(link)));
    }

    fn caller(&self, script: i64) -> Option<Caller> {
        let link = self.link.get()?;
        Some(Caller::new(link.get(), script))
    }

    fn add(&self, name: &str, factory: Rc<NativeScriptFactory>) -> Vec<u8> {
        self.count.set(self.count.get() + 1);
        let number = self.count.get();
        // A scene that is saved and loaded elsewhere raises the error: Lua is what scripts of unknown languages are in.
        let name = name.replace(|c: char| c.is_control() || "'\\".contains(c), "_");
        let text = format!(
            "error('the program that added the script {name} (native {number}) is not there.', 0)"
        );
        self.factories
            .borrow_mut()
            .insert(text.clone().into_bytes(), Rc::new(Outer::new(factory)));
        text.into_bytes()
    }
}

impl Simulator {
    /// Adds a script whose functions belong to the program. `create` is called each time it starts; customization scripts and add-ons
    /// start at once, a simulation script with the simulation. Its text in the scene is only a name: a scene that is saved does not
    /// contain it.
    ///
    /// # Errors
    /// When the scene is full, or for the sandbox and the main script, which are in Lua.
    pub fn add_native_script(
        &mut self,
        kind: ScriptKind,
        name: &str,
        create: impl Fn(Caller) -> Result<Box<dyn NativeScript>, String> + 'static,
    ) -> Result<ScriptRef, Error> {
        let script_type = match kind {
            ScriptKind::Customization => ScriptType::Customization,
            ScriptKind::Simulation => ScriptType::Simulation,
            ScriptKind::AddOn => return Ok(self.add_native_add_on(name, Rc::new(create))),
            ScriptKind::Sandbox | ScriptKind::Main => return Err(ApiError::NoSuchScript.into()),
        };
        let text = self.add_factory(name, Rc::new(create));
        let sim = self.inside();
        let mut object = ScriptObject::new(script_type, text.clone(), LANGUAGE, false);
        // Scripts of languages that the scene does not know are disabled at first.
        object.disabled = false;
        let object = Kind::Script(Box::new(object));
        let alias = if name.is_empty() { "Script" } else { name };
        let added = sim.scene.borrow_mut().add(alias, object);
        let handle = added.map_err(ApiError::from)?;
        let script = sim.script(handle.raw()).ok_or(ApiError::NoSuchScript)?;
        if script_type == ScriptType::Customization {
            sim.init_script(&script);
        }
        Ok(ScriptRef(script.id))
    }

    /// Keeps what makes a script; returns the text of its object.
    fn add_factory(&self, name: &str, create: Rc<NativeScriptFactory>) -> Vec<u8> {
        let _inside = self.inside();
        self.parts.native_scripts.add(name, create)
    }

    fn add_native_add_on(&mut self, name: &str, create: Rc<NativeScriptFactory>) -> ScriptRef {
        let text = self.add_factory(name, create);
        let sim = self.inside();
        let detached = Detached {
            language: LANGUAGE.to_owned(),
            ..Detached::of_text(&format!("{name}@addOnScript"), &text)
        };
        let script = sim.scripts.add_detached(ScriptType::AddOn, detached);
        sim.start_detached(&script);
        ScriptRef(script.id)
    }

    /// Calls of API functions in the name of a script.
    pub fn caller(&self, script: &ScriptRef) -> Caller {
        let _inside = self.inside();
        Caller::new(&self.link, script.0)
    }
}

/// The language of these scripts.
pub(super) struct NativeLanguage(pub Rc<NativeScripts>);

impl Language for NativeLanguage {
    fn name(&self) -> &'static str {
        LANGUAGE
    }

    fn create(&self, env: Rc<Env>) -> Rc<Runtime> {
        let interpreter = Running {
            env: Rc::clone(&env),
            script: OnceCell::new(),
            resource: RefCell::default(),
            lua: OnceCell::new(),
            scripts: Rc::clone(&self.0),
        };
        Runtime::new(env, interpreter)
    }
}

/// A running script.
struct Running {
    env: Rc<Env>,
    script: OnceCell<Outer<Box<dyn NativeScript>>>,
    resource: RefCell<Option<Resource>>,
    /// Runs the functions of the library that are written in Lua.
    lua: OnceCell<Rc<Runtime>>,
    scripts: Rc<NativeScripts>,
}

impl Running {
    fn caller(&self) -> Result<Caller, ScriptError> {
        let caller = self.scripts.caller(self.env.script.id);
        caller.ok_or_else(|| ScriptError::new("the simulator is gone."))
    }

    fn lua(&self) -> Result<&Runtime, ScriptError> {
        if self.lua.get().is_none() {
            let sim = self
                .env
                .simulator()
                .ok_or_else(|| ScriptError::new("the simulator is gone."))?;
            let lua = sim.create_runtime(&self.env.script, "lua")?;
            lua.interpreter.start()?;
            // It was empty a moment ago, and nothing else sets it.
            let _ = self.lua.set(lua);
        }
        self.lua
            .get()
            .map(Rc::as_ref)
            .ok_or_else(|| ScriptError::new("there is no Lua interpreter."))
    }

    fn defined(&self, name: &str) -> Option<&Outer<Box<dyn NativeScript>>> {
        let script = self.script.get();
        script.filter(|script| script.with(|script| script.defines(name)))
    }
}

/// Calls a function of the program, in its own memory.
fn call_out(
    script: &Outer<Box<dyn NativeScript>>,
    name: &str,
    args: &[Data],
) -> Result<Vec<Data>, String> {
    brought_in(|| script.with(|script| script.call(name, args)))
}

impl Interpreter for Running {
    fn start(&self) -> Result<(), ScriptError> {
        Ok(())
    }

    fn load(&self, source: &SourceText<'_>) -> Result<(), ScriptError> {
        let factory = self.scripts.factories.borrow().get(source.text).cloned();
        let missing = || ScriptError::new("the program that added this script is not there.");
        let (factory, caller) = (factory.ok_or_else(missing)?, self.caller()?);
        let script = factory.with(|factory| factory(caller).map(Outer::new));
        let script = script.map_err(|error| ScriptError::new(brought_in(move || error)))?;
        if !script.with(|script| script.is_stateless()) {
            let name =
                || "the variables of a script of the program around the simulator".to_owned();
            self.resource.replace(Some(Resource::new(name)));
        }
        // A text is loaded once.
        let _ = self.script.set(script);
        Ok(())
    }

    fn defines(&self, call: SysCall) -> bool {
        self.defined(call.name()).is_some()
    }

    fn call_callback(&self, call: SysCall, args: &[Data]) -> Result<CallbackResult, ScriptError> {
        let Some(script) = self.defined(call.name()) else {
            return Ok(CallbackResult::NotDefined);
        };
        let results = call_out(script, call.name(), args).map_err(ScriptError::new)?;
        Ok(CallbackResult::Returned(results.into_iter().last()))
    }

    fn call_hook(&self, hook: &Hook, args: &[Data]) -> Result<bool, ScriptError> {
        let Some(script) = self.defined(&hook.name) else {
            return Ok(false);
        };
        call_out(script, &hook.name, args)
            .map(|_| true)
            .map_err(ScriptError::new)
    }

    fn resume_thread(&self) -> Result<(), ScriptError> {
        self.script.get().map_or(Ok(()), |script| {
            brought_in(|| script.with(|script| script.resume_thread())).map_err(ScriptError::new)
        })
    }

    fn call(&self, function: Callee<'_>, args: &[Data]) -> Result<Vec<Data>, CallError> {
        // Its functions have names only: none was passed as a value.
        let Callee::Named(name) = function else {
            return Err(CallError::NoSuchFunction);
        };
        let results = match self.defined(SysCall::Ext.name()) {
            Some(script) => {
                let args = [&[Data::text(name)], args].concat();
                call_out(script, SysCall::Ext.name(), &args)
            }
            None => {
                let script = self.defined(name).ok_or(CallError::NoSuchFunction)?;
                call_out(script, name, args)
            }
        };
        results.map_err(|error| ScriptError::new(error).into())
    }

    fn run(&self, text: &[u8], _: &str) -> Result<(), ScriptError> {
        self.evaluate(text).map(drop)
    }

    fn evaluate(&self, text: &[u8]) -> Result<Vec<Data>, ScriptError> {
        let script = self
            .script
            .get()
            .ok_or_else(|| ScriptError::new("the script has not started."))?;
        brought_in(|| script.with(|script| script.evaluate(text))).map_err(ScriptError::new)
    }

    fn call_library(
        &self,
        module: &str,
        function: &str,
        args: &[Data],
    ) -> Result<Vec<Data>, ScriptError> {
        self.lua()?.interpreter.call_library(module, function, args)
    }

    fn release(&self, _: FunctionRef) {}

    fn traceback(&self) -> String {
        self.script
            .get()
            .map(|script| brought_in(|| script.with(|script| script.traceback())))
            .unwrap_or_default()
    }
}
