//! Scripts: finding them, and calling them.

use std::rc::Rc;

use super::Cx;
use crate::error::{ApiError, ApiResult};
use crate::function_ref::FunctionRef;
use crate::host::{Script, ScriptGroup};
use crate::sys_call::SysCall;
use scene::object::script_object::ScriptType;
use scene::{Data, Handle};

impl Cx<'_> {
    /// The script with that handle.
    pub fn script_by_handle(&self, handle: i64) -> Option<Rc<Script>> {
        self.sim.script(handle)
    }

    /// The script of that type attached to an object: the first of its children by priority, else the object itself.
    pub fn script_attached_to(&self, object: Handle, script_type: ScriptType) -> Option<i64> {
        self.sim.script_attached_to(object, script_type)
    }

    /// The script of that type and name: a path for scene scripts, the display name for add-ons, nothing for main and sandbox.
    ///
    /// # Errors
    /// When there is none.
    pub fn script_by_name(&self, script_type: ScriptType, name: &str) -> ApiResult<i64> {
        self.sim.script_by_name(script_type, name)
    }

    /// Handles of the scripts that are no objects, in the order of their creation.
    pub fn detached_scripts(&self) -> Vec<i64> {
        let scripts = self.sim.scripts.all_detached();
        scripts.iter().map(|script| script.id).collect()
    }

    /// Script calls in progress, over all states.
    pub fn call_depth(&self) -> usize {
        self.sim.scripts.depth()
    }

    /// Calls the global function `name` (dots walk through tables) of a script.
    ///
    /// # Errors
    /// In CoppeliaSim's words; the callee's own error is logged under its name and ends it.
    pub fn call_function(
        &mut self,
        script: &Rc<Script>,
        name: &str,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        self.sim.call_function(script, name, args)
    }

    /// Runs a string in a script: as an expression if it is one, else as a chunk.
    ///
    /// # Errors
    /// When it fails.
    pub fn execute_string(&mut self, script: &Rc<Script>, code: &[u8]) -> ApiResult<Vec<Data>> {
        self.sim.execute_string(script, code)
    }

    /// Sends a message to all initialised scripts but the calling one.
    pub fn broadcast_message(&mut self, args: &[Data]) {
        self.sim.broadcast_message(self.script().id, args);
    }

    /// Calls a callback of the scripts of a group; returns how many ran it.
    pub fn call_group(&mut self, group: ScriptGroup, call: SysCall, args: &[Data]) -> i64 {
        self.sim.deliver_to(group, call, args)
    }

    /// Calls a callback of simulation scripts, then of customization scripts; returns how many ran it.
    pub fn call_embedded(&mut self, call: SysCall, args: &[Data]) -> i64 {
        self.sim.deliver_to_embedded(call, args)
    }

    /// Resets a script and, where 4.10 does, initialises it at once.
    pub fn init_script(&mut self, script: &Rc<Script>) {
        self.sim.init_script(script);
    }

    /// Removes a script that is no object, now or later.
    pub fn remove_attached_script(&mut self, script: &Rc<Script>) {
        self.sim.remove_attached_script(script);
    }

    /// A new script without an object; returns its handle.
    pub fn add_script_without_object(&mut self, script_type: ScriptType) -> i64 {
        self.sim.scripts.add_without_object(script_type)
    }

    /// Attaches a script that is no object to an object, or to none.
    pub fn reattach_script(&mut self, script: &Script, owner: Option<Handle>) {
        self.sim.scripts.reattach(script, owner);
    }

    /// The calls in progress of a script, as its language shows them.
    ///
    /// # Errors
    /// When the script does not run.
    pub fn traceback(&self, script: &Script) -> ApiResult<String> {
        match self.stack.filter(|_| script.id == self.script().id) {
            Some(stack) => Ok(stack.traceback()),
            None => {
                let runtime = script
                    .current_runtime()
                    .ok_or(ApiError::ScriptNotInitialized)?;
                Ok(runtime.interpreter.traceback())
            }
        }
    }

    /// Releases a function that the calling script has passed to the host.
    pub fn release_function(&self, function: FunctionRef) {
        if let Some(runtime) = self.env.runtime() {
            runtime.interpreter.release(function);
        }
    }

    /// Ends a script as a crash would: without its cleanup.
    pub fn abort_script(&mut self, script: &Script) {
        self.sim.abort(script);
    }
}
