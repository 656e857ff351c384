//! The context of one API call.

use std::any::TypeId;
use std::cell::{Ref, RefMut};
use std::rc::Rc;

use crate::scene::Scene;
use crate::script::error::{ApiError, ApiResult};
use crate::script::lifecycle::env::Env;
use crate::script::lifecycle::instance::Script;
use crate::script::lua::Stack;
use crate::script::sim::Sim;

/// What an API function gets: `&Cx` to read, `&mut Cx` to write the scene or call scripts. A function cannot hold a borrow of the
/// scene while it calls a script, because both need the context.
pub struct Cx<'a> {
    sim: Rc<Sim>,
    stack: Stack<'a>,
}

impl<'a> Cx<'a> {
    pub(crate) fn of(stack: Stack<'a>) -> ApiResult<Self> {
        let sim = Env::of(stack).sim.upgrade().ok_or_else(|| ApiError::Other("the simulator is gone.".into()))?;
        Ok(Self { sim, stack })
    }

    /// The script that is calling.
    pub(crate) fn script(&self) -> &Rc<Script> {
        &self.env().script
    }

    pub(crate) fn env(&self) -> &'a Env {
        Env::of(self.stack)
    }

    pub(crate) fn stack(&self) -> Stack<'a> {
        self.stack
    }

    pub(crate) fn sim(&self) -> &Rc<Sim> {
        &self.sim
    }

    /// For functions that start programs or load native libraries.
    ///
    /// # Errors
    /// When scripts may not do that.
    pub(crate) fn require_unsafe(&self) -> ApiResult<()> {
        if self.sim.options.exec_unsafe { Ok(()) } else { Err(ApiError::Unsafe) }
    }

    /// What a library keeps for the calling script's state: made at the first call, dropped with the state.
    pub(crate) fn library_data<T: Default + 'static>(&self) -> Rc<T> {
        let mut all = self.env().library_data.borrow_mut();
        let data = Rc::clone(all.entry(TypeId::of::<T>()).or_insert_with(|| Rc::new(T::default())));
        data.downcast().expect("the key is the type")
    }

    /// Whether the caller is a thread that may hand over to the simulation now.
    pub(crate) fn can_yield(&self) -> bool {
        self.env().yields.overall.get() == 0 && !self.stack.is_main_coroutine()
    }

    /// Ends the time slice of the calling thread, as work does that takes longer in the original.
    pub(crate) fn use_up_slice(&self) {
        crate::script::use_up_slice(self.stack);
    }

    pub(crate) fn scene(&self) -> Ref<'_, Scene> {
        self.sim.scene.borrow()
    }

    pub(crate) fn scene_mut(&mut self) -> RefMut<'_, Scene> {
        self.sim.scene.borrow_mut()
    }
}
