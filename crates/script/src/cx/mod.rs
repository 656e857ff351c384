//! The context of one API call, and all that a function may touch.
//!
//! Methods of `&Cx` read; methods of `&mut Cx` change something or call scripts, even if through a cell. Nothing here returns the
//! simulator as a whole: an accessor is named after its part.

mod events;
mod files;
mod handlers;
mod host;
mod names;
mod objects;
mod output;
mod outside;
mod properties;
mod scripts;
mod sensors;
mod simulation;
mod ui;
mod vision;

use std::cell::{Ref, RefMut};
use std::rc::Rc;
use std::time::Duration;

use crate::binding::args::Args;
use crate::binding::source::{Caller, Source};
use crate::error::{ApiError, ApiResult};
use crate::host::{Env, Script, Sim};
use crate::lua::Stack;
use crate::lua_runtime::threads;
use crate::options::Options;
use permissions::Permissions;
use scene::Scene;

/// The context of an API function: `&Cx` to read, `&mut Cx` to write the scene or call scripts. A function cannot hold a borrow of the
/// scene while it calls a script, because both need the context.
pub struct Cx<'a> {
    sim: Rc<Sim>,
    env: &'a Env,
    /// None when the call does not come from Lua.
    stack: Option<Stack<'a>>,
}

impl<'a, S: Source<'a>> Args<'a, S> {
    /// The context of the call.
    ///
    /// # Errors
    /// When the simulator is gone.
    pub fn context(&self) -> ApiResult<Cx<'a>> {
        Cx::new(self.caller())
    }
}

impl<'a> Cx<'a> {
    fn new(caller: Caller<'a>) -> ApiResult<Self> {
        let (env, stack): (&Env, _) = match caller {
            Caller::Lua(stack) => (stack.env(), Some(stack)),
            Caller::Environment(env) => (
                env.downcast_ref()
                    .expect("functions are called with an environment"),
                None,
            ),
        };
        let sim = env
            .sim
            .upgrade()
            .ok_or_else(|| ApiError::Other("the simulator is gone.".into()))?;
        Ok(Self { sim, env, stack })
    }

    /// The script that is calling.
    pub fn script(&self) -> &'a Rc<Script> {
        &self.env().script
    }

    /// The environment of the calling script.
    pub fn env(&self) -> &'a Env {
        self.env
    }

    /// The options of the simulator.
    pub fn options(&self) -> &Options {
        &self.sim.options
    }

    /// Permissions of the script. Functions check them before they call the operating system for it.
    pub fn permissions(&self) -> &Permissions {
        &self.sim.options.permissions
    }

    /// Whether the program is being stopped.
    pub fn is_interrupted(&self) -> bool {
        self.sim.options.is_interrupted()
    }

    /// Asks again and again until there is an answer; None when there is none within `limit`.
    ///
    /// # Errors
    /// When the program is being stopped.
    pub fn wait_for<T>(
        &self,
        limit: Option<Duration>,
        answer: impl FnMut() -> Option<T>,
    ) -> ApiResult<Option<T>> {
        self.sim.options.wait_for(limit, answer)
    }

    /// The state of a module for the simulator: created by the first call, dropped with the simulator.
    pub fn module_state<T: Default + 'static>(&self) -> Rc<T> {
        self.sim.modules.states.get()
    }

    /// The state of a module for the calling script: created by the first call, dropped with the script's interpreter.
    pub fn script_state<T: Default + 'static>(&self) -> Rc<T> {
        self.env().module_states.get()
    }

    /// Whether the caller is a thread that may hand over to the simulation now.
    pub fn can_yield(&self) -> bool {
        self.env().yields.overall.get() == 0
            && self.stack.is_some_and(|stack| !stack.is_main_coroutine())
    }

    /// Level of the calling coroutine: 0 means it may be pre-empted.
    ///
    /// # Errors
    /// When the call does not come from Lua.
    pub fn auto_level(&self) -> ApiResult<i64> {
        self.stack
            .map(threads::auto_level)
            .ok_or(ApiError::NeedsLua)
    }

    /// Sets the level of the calling coroutine.
    ///
    /// # Errors
    /// When the call does not come from Lua.
    pub fn set_auto_level(&mut self, level: i64) -> ApiResult<()> {
        self.stack
            .map(|stack| threads::set_auto_level(stack, level))
            .ok_or(ApiError::NeedsLua)
    }

    /// Ends the time slice of the calling thread, as work does that takes longer in the original.
    pub fn end_time_slice(&self) {
        if let Some(stack) = self.stack {
            threads::end_time_slice(stack);
        }
    }

    /// The scene, to read. The borrow must end before scripts are called or the scene is changed.
    pub fn scene(&self) -> Ref<'_, Scene> {
        self.sim.scene.borrow()
    }

    /// The scene, to change. The borrow must end before scripts are called or the scene is read.
    pub fn scene_mut(&mut self) -> RefMut<'_, Scene> {
        self.sim.scene.borrow_mut()
    }
}
