//! Calls of API functions by programs, in the name of a script.

use std::rc::{Rc, Weak};

use super::Error;
use heap::{Handle, enter_and_copy};
use scene::Data;
use script::{ApiError, Member, Script, Sim, SimulationState, is_short};

/// The library's helper for calls from programs.
const HELPER: &str = "swanilda.calls";

/// The way of the program to a simulator, which it does not keep alive. The simulator counts one of them, made with it: what the program
/// makes and drops of its own is counted outside, where no restore brings back the count.
pub(crate) type Link = Rc<Weak<Sim>>;

/// Calls API functions in the name of a script, also while scripts run. It does not keep the simulator alive.
#[derive(Clone)]
pub struct Caller {
    sim: Link,
    script: i64,
    heap: Option<Handle>,
}

/// A name of a module or a global function, looked up once for many calls.
#[derive(Debug, Clone)]
pub struct ApiFunction {
    name: Box<str>,
    member: Option<Member>,
}

/// How far a call has come.
#[derive(Debug, Clone, PartialEq)]
pub enum Progress {
    /// It has returned these results.
    Done(Vec<Data>),
    /// It waits for simulation steps: run one, then [`Caller::resume`] it by this number.
    Waits(i64),
}

/// A member of a module.
#[derive(Debug, Clone, PartialEq)]
pub enum ModuleMember {
    /// A constant.
    Constant(Data),
    /// The constants of an enumeration, by name.
    Enumeration(Vec<(String, i64)>),
    /// A function.
    Function(ApiFunction),
}

impl PartialEq for ApiFunction {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl ApiFunction {
    /// `module.function`, or the name of a global.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it returns at once: it reads or sets values, and runs no script.
    pub fn is_short(&self) -> bool {
        self.member
            .as_ref()
            .is_some_and(|member| is_short(&self.name, member))
    }

    /// Whether it is written in Lua, so that it may wait for steps.
    pub fn is_lua(&self) -> bool {
        !matches!(self.member, Some(Member::Native(_) | Member::Missing(_)))
    }
}

impl Caller {
    /// Calls in the name of that script; made in the memory of the simulator.
    pub(super) fn new(sim: &Link, script: i64) -> Self {
        Self {
            sim: Rc::clone(sim),
            script,
            heap: Handle::current(),
        }
    }

    /// The handle of the script.
    pub fn handle(&self) -> i64 {
        self.script
    }

    /// Simulated time, seconds; 0 when the simulator is gone.
    pub fn time(&self) -> f64 {
        self.sim.upgrade().map_or(0.0, |sim| sim.clock.time())
    }

    /// Steps since the start; 0 when the simulator is gone.
    pub fn steps(&self) -> u64 {
        self.sim.upgrade().map_or(0, |sim| sim.clock.steps())
    }

    /// Stopped when the simulator is gone.
    pub fn state(&self) -> SimulationState {
        self.sim
            .upgrade()
            .map_or(SimulationState::Stopped, |sim| sim.clock.state())
    }

    /// Number of uncaught script errors.
    pub fn errors(&self) -> u64 {
        self.sim.upgrade().map_or(0, |sim| sim.log.errors())
    }

    fn sim(&self) -> Result<Rc<Sim>, Error> {
        self.sim.upgrade().ok_or(Error::Api(ApiError::Interrupted))
    }

    /// The function of that name. Whether it exists is known when it is called.
    pub fn function(&self, name: &str) -> ApiFunction {
        let member = self
            .sim
            .upgrade()
            .and_then(|sim| sim.modules.registry.find(name));
        ApiFunction {
            name: name.into(),
            member,
        }
    }

    /// Calls a function. One that is written in Lua cannot wait for steps here.
    ///
    /// # Errors
    /// The error of the function, with the text that scripts receive; or when there is no such function.
    pub fn call(&self, function: &ApiFunction, args: &[Data]) -> Result<Vec<Data>, Error> {
        if !function.is_lua() {
            return self.inside(|sim, script| {
                sim.call_member(script, function.member, &function.name, args)
            });
        }
        self.helper("call", &function.name, args)
    }

    /// Calls a function that may wait for steps. Only for calls from outside of the simulation loop.
    ///
    /// # Errors
    /// As `call`.
    pub fn begin(&self, function: &ApiFunction, args: &[Data]) -> Result<Progress, Error> {
        if function.is_lua() {
            progress(self.helper("begin", &function.name, args)?)
        } else {
            self.call(function, args).map(Progress::Done)
        }
    }

    /// Goes on with a call that waits, after a step.
    ///
    /// # Errors
    /// As `call`; or when there is no such call.
    pub fn resume(&self, number: i64) -> Result<Progress, Error> {
        progress(self.library("resume", &[Data::Int(number)])?)
    }

    /// Ends a call that waits.
    pub fn cancel(&self, number: i64) {
        // Without a simulator there is nothing left to cancel.
        let _ = self.library("cancel", &[Data::Int(number)]);
    }

    /// Makes sure that `require` finds a module.
    ///
    /// # Errors
    /// As that of `require` in scripts.
    pub fn require(&self, module: &str) -> Result<(), Error> {
        if self.sim()?.modules.registry.module(module).is_some() {
            return Ok(());
        }
        self.library("require", &[Data::text(module)]).map(drop)
    }

    /// The member of a module; None when it has no such member.
    ///
    /// # Errors
    /// When the module cannot be loaded.
    pub fn member(&self, module: &str, name: &str) -> Result<Option<ModuleMember>, Error> {
        let full = format!("{module}.{name}");
        let sim = self.sim()?;
        match sim
            .modules
            .registry
            .module(module)
            .and_then(|namespace| namespace.get(name))
        {
            Some(Member::Constant(value)) => {
                return Ok(Some(ModuleMember::Constant(Data::Int(value))));
            }
            Some(_) => return Ok(Some(ModuleMember::Function(self.function(&full)))),
            None => {}
        }
        let enumeration = self.enumeration(&sim, module, name);
        if !enumeration.is_empty() {
            return Ok(Some(ModuleMember::Enumeration(enumeration)));
        }
        let found = self.library("member", &[Data::text(module), Data::text(name)])?;
        Ok(match &found[..] {
            [Data::Text(kind)] if kind == b"function" => {
                Some(ModuleMember::Function(self.function(&full)))
            }
            [_, value] => Some(ModuleMember::Constant(value.clone())),
            _ => None,
        })
    }

    /// The names of a module's members, in alphabetical order.
    ///
    /// # Errors
    /// When the module cannot be loaded.
    pub fn member_names(&self, module: &str) -> Result<Vec<String>, Error> {
        if let Some(namespace) = self.sim()?.modules.registry.module(module) {
            return Ok(namespace
                .names()
                .into_iter()
                .filter(|name| !name.contains('.'))
                .map(str::to_owned)
                .collect());
        }
        let names = self.library("members", &[Data::text(module)])?;
        let Some(Data::Array(names)) = names.into_iter().next() else {
            return Ok(Vec::new());
        };
        let text = |name| {
            if let Data::Text(name) = name {
                String::from_utf8(name).ok()
            } else {
                None
            }
        };
        Ok(names.into_iter().filter_map(text).collect())
    }

    fn enumeration(&self, sim: &Sim, module: &str, name: &str) -> Vec<(String, i64)> {
        let Some(namespace) = sim.modules.registry.module(module) else {
            return Vec::new();
        };
        let prefix = format!("{name}.");
        let member = |full: &str| match namespace.get(full) {
            Some(Member::Constant(value)) => Some((full.strip_prefix(&prefix)?.to_owned(), value)),
            _ => None,
        };
        namespace.names().into_iter().filter_map(member).collect()
    }

    /// Calls a function of the helper with the name of a function, split, and its arguments.
    fn helper(&self, how: &str, name: &str, args: &[Data]) -> Result<Vec<Data>, Error> {
        let (module, member) = name.rsplit_once('.').unwrap_or(("_G", name));
        let names = [
            Data::Int(self.handle()),
            Data::text(module),
            Data::text(member),
            Data::Int(args.len() as i64),
        ];
        self.library(how, &[&names[..], args].concat())
    }

    fn library(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, Error> {
        self.inside(|sim, script| {
            let results = sim.call_library_function(script, HELPER, function, args);
            results.map_err(without_place)
        })
    }

    /// Runs `work` in the memory of the simulator, with the script; what it returns is copied out.
    fn inside<T: Clone>(
        &self,
        work: impl FnOnce(&Rc<Sim>, &Rc<Script>) -> Result<T, ApiError>,
    ) -> Result<T, Error> {
        let sim = self.sim()?;
        enter_and_copy(self.heap, || {
            let script = sim.script(self.script).ok_or(ApiError::NoSuchScript)?;
            work(&sim, &script)
        })
        .map_err(Error::Api)
    }
}

/// What the helper says of a call: the number of one that waits, or false and its results.
fn progress(mut results: Vec<Data>) -> Result<Progress, Error> {
    match results.first() {
        Some(&Data::Int(number)) => Ok(Progress::Waits(number)),
        Some(_) => {
            results.remove(0);
            Ok(Progress::Done(results))
        }
        None => Err(Error::Api(ApiError::CallFailed)),
    }
}

fn without_place(error: ApiError) -> ApiError {
    match error {
        ApiError::Other(text) => ApiError::Other(reason(&text).to_owned()),
        other => other,
    }
}

/// The reason alone: `17: in sim._getObject: ` before it is a place in the library.
pub(crate) fn reason(text: &str) -> &str {
    let is_line = |line: &str| {
        let number = line.rsplit(':').next();
        number.is_some_and(|number| number.parse::<u32>().is_ok())
    };
    let text = match text.split_once(": ") {
        Some((line, rest)) if is_line(line) => rest,
        _ => text,
    };
    let function = text
        .strip_prefix("in ")
        .and_then(|rest| rest.split_once(": "));
    function.map_or(text, |(_, rest)| rest)
}

#[cfg(test)]
mod tests {
    use super::{ApiError, without_place};

    #[test]
    fn errors_of_the_library_lose_their_place() {
        for (text, reason) in [
            (
                "17: in sim._getObject: object does not exist.",
                "object does not exist.",
            ),
            ("sim/motion:3: there is no path", "there is no path"),
            ("sim.wait: cannot wait here", "sim.wait: cannot wait here"),
        ] {
            assert_eq!(
                without_place(ApiError::Other(text.into())),
                ApiError::Other(reason.into())
            );
        }
    }
}
