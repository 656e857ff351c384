//! What hooks of modules may touch: narrower than what calls may.

use std::cell::Ref;
use std::rc::Rc;

use crate::binding::hooks::Host;
use crate::calls::handler::Handler;
use crate::clock::Clock;
use crate::error::{ApiError, ApiResult};
use crate::host::{Script, Sim};
use crate::options::Options;
use io::EventLoop;
use scene::object::script_object::ScriptType;
use scene::{Data, Scene};

impl Host<'_> {
    fn sim(&self) -> &Rc<Sim> {
        self.0
            .downcast_ref()
            .expect("hooks are called with a simulator")
    }

    /// The state of a module, if a call has created it.
    pub fn module_state<T: 'static>(&self) -> Option<Rc<T>> {
        self.sim().modules.states.existing()
    }

    /// The event loop of this simulator's sockets.
    ///
    /// # Errors
    /// When the system cannot create one.
    pub fn event_loop(&self) -> std::io::Result<Rc<EventLoop>> {
        self.sim().event_loop.get()
    }

    /// Calls a handler of a script; None if it fails, which is logged.
    pub fn call_handler(
        &self,
        script: &Rc<Script>,
        handler: &Handler,
        args: &[Data],
    ) -> Option<Vec<Data>> {
        self.sim().call_handler(script, handler, args)
    }

    /// The value of a named parameter of the application.
    pub fn named_param(&self, name: &str) -> Option<Vec<u8>> {
        self.sim().app.borrow().named_params.get(name).cloned()
    }

    /// Logs a line in the name of the simulator; `level` is one of `sim.verbosity_*`.
    pub fn log(&self, level: i64, text: &str) {
        self.sim().log(level, text);
    }

    /// The options of the simulator.
    pub fn options(&self) -> &Options {
        &self.sim().options
    }

    /// State and time of the simulation.
    pub fn clock(&self) -> &Clock {
        &self.sim().clock
    }

    /// The scene, to read. The borrow must end before scripts are called.
    pub fn scene(&self) -> Ref<'_, Scene> {
        self.sim().scene.borrow()
    }

    /// Distinguishes this scene from others.
    pub fn scene_uid(&self) -> i64 {
        self.sim().scene_uid()
    }

    /// Calls `module.function` in the name of the sandbox, with plain values.
    ///
    /// # Errors
    /// Those of the function.
    pub fn call_api(&self, name: &str, args: &[Data]) -> ApiResult<Vec<Data>> {
        self.sim().call_api(&self.sandbox()?, name, args)
    }

    /// As [`Host::call_api`], for a function that only the Lua part of its module has.
    ///
    /// # Errors
    /// Those of the function.
    pub fn call_inner(&self, name: &str, args: &[Data]) -> ApiResult<Vec<Data>> {
        let sandbox = self.sandbox()?;
        let member = self.sim().modules.registry.find_inner(name);
        self.sim().call_member(&sandbox, member, name, args)
    }

    fn sandbox(&self) -> ApiResult<Rc<Script>> {
        let scripts = &self.sim().scripts;
        scripts
            .detached(ScriptType::Sandbox)
            .ok_or(ApiError::NoSuchScript)
    }

    /// Calls a global function of a script.
    ///
    /// # Errors
    /// When there is no such script or function, or the function fails.
    pub fn call_function(&self, script: i64, name: &str, args: &[Data]) -> ApiResult<Vec<Data>> {
        let script = self.sim().script(script).ok_or(ApiError::NoSuchScript)?;
        self.sim().call_function(&script, name, args)
    }
}
