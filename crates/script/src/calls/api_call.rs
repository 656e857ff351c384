//! Calls of API functions by name, with plain values.

use std::rc::Rc;

use crate::binding::registry::Member;
use crate::error::{ApiError, ApiResult};
use crate::host::{Level, Runtime, Script, Sim};
use scene::Data;

impl Sim {
    /// Calls `module.function`, or a global function, in the name of a script. A native function is called directly; one that is written
    /// in Lua, by the interpreter of that script.
    ///
    /// # Errors
    /// The errors of the function, or when there is no such function.
    pub fn call_api(&self, caller: &Rc<Script>, name: &str, args: &[Data]) -> ApiResult<Vec<Data>> {
        self.call_member(caller, self.modules.registry.find(name), name, args)
    }

    /// The same for a name that was looked up before.
    ///
    /// # Errors
    /// As `call_api`.
    pub fn call_member(
        &self,
        caller: &Rc<Script>,
        member: Option<Member>,
        name: &str,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        let runtime = caller
            .current_runtime()
            .ok_or(ApiError::ScriptNotInitialized)?;
        let registry = &self.modules.registry;
        match member {
            Some(Member::Native(id)) => runtime.env.call_native(registry.bound(id), args),
            Some(Member::Missing(id)) => Err(registry.missing_function(id).error()),
            Some(Member::Constant(_)) => Err(ApiError::CallFailed),
            Some(Member::Lua { .. }) | None => self.call_library(&runtime, name, args),
        }
    }

    /// Calls a function of a module by the Lua interpreter of a script.
    ///
    /// # Errors
    /// The first line of the function's error, or when the script is not running.
    pub fn call_library_function(
        &self,
        caller: &Rc<Script>,
        module: &str,
        function: &str,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        let runtime = caller
            .current_runtime()
            .ok_or(ApiError::ScriptNotInitialized)?;
        self.call_library_in(&runtime, module, function, args)
    }

    fn call_library(
        &self,
        runtime: &Rc<Runtime>,
        name: &str,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        let (module, member) = name.rsplit_once('.').ok_or(ApiError::CallFailed)?;
        self.call_library_in(runtime, module, member, args)
    }

    fn call_library_in(
        &self,
        runtime: &Rc<Runtime>,
        module: &str,
        member: &str,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        let _level = Level::enter(&self.scripts, &runtime.env);
        let results = runtime.interpreter.call_library(module, member, args);
        results.map_err(|error| {
            ApiError::Other(error.text.lines().next().unwrap_or_default().to_owned())
        })
    }
}
