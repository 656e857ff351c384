//! Nested calls: each state and the simulator know how many are in progress.

use crate::host::{Env, ScriptSet};

/// One call into a state, from its beginning to its end.
pub(crate) struct Level<'a> {
    scripts: &'a ScriptSet,
    env: &'a Env,
    pub too_deep: bool,
}

impl<'a> Level<'a> {
    /// A call that another script makes: nothing in it can yield.
    pub(crate) fn enter_from_script(scripts: &'a ScriptSet, env: &'a Env) -> Self {
        let level = Self::enter(scripts, env);
        if env.depth.get() == 1 {
            env.yields.overall.set(1);
        }
        level
    }

    /// A call the host makes. The outermost one begins a time slice and forgets locks; inner ones cannot yield.
    pub(crate) fn enter(scripts: &'a ScriptSet, env: &'a Env) -> Self {
        let too_deep = !scripts.enter();
        env.script.idle.take();
        let depth = env.depth.get();
        env.depth.set(depth + 1);
        if depth == 0 {
            env.yields.begin_slice();
        } else {
            env.yields.overall.set(env.yields.overall.get() + 1);
        }
        Self {
            scripts,
            env,
            too_deep,
        }
    }
}

impl Level<'_> {
    /// Another call of the host into the same state begins.
    pub(crate) fn begin_slice(&self) {
        self.env.yields.begin_slice();
    }
}

impl Drop for Level<'_> {
    fn drop(&mut self) {
        self.scripts.leave();
        let depth = self.env.depth.get() - 1;
        self.env.depth.set(depth);
        if depth > 0 {
            self.env
                .yields
                .overall
                .set((self.env.yields.overall.get() - 1).max(0));
        }
    }
}
