//! The world outside of the simulator.

use std::rc::Rc;

use super::Cx;
use crate::error::ApiResult;
use c_interface::Plugin;
use io::EventLoop;
use scene::Data;

impl Cx<'_> {
    /// Whether a plugin of CoppeliaSim is a module here, and no library of that name is to be found.
    pub fn has_module_for_plugin(&self, name: &str) -> bool {
        self.sim.has_module_for_plugin(name)
    }

    /// Loads a native plugin for the calling script, unless it is loaded. None where it cannot be loaded; the log says why.
    ///
    /// # Errors
    /// When native code is not allowed.
    pub fn load_plugin(&mut self, name: &str) -> ApiResult<Option<Rc<Plugin>>> {
        self.permissions()
            .check_native(&format!("loading the plugin '{name}'"))?;
        Ok(self.sim.load_plugin(self.script(), name))
    }

    /// Name and version of a native plugin by its place in the order in which they were loaded.
    pub fn plugin_by_place(&self, place: usize) -> Option<(String, i32)> {
        self.sim.plugin_by_place(place)
    }

    /// The names of the functions for scripts that the program has registered which has loaded the simulator as a library.
    pub fn functions_of_program(&self) -> Vec<String> {
        self.sim.functions_of_program()
    }

    /// Calls a function of a plugin, or of that program, by its place.
    ///
    /// # Errors
    /// The plugin's.
    pub fn call_plugin(
        &mut self,
        plugin: Option<&str>,
        function: usize,
        args: Vec<Data>,
    ) -> ApiResult<Vec<Data>> {
        self.sim.call_plugin(self.script(), plugin, function, args)
    }

    /// The calling script uses a plugin no longer; it is unloaded with its last user, or at once.
    ///
    /// # Errors
    /// When it is not loaded, or running.
    pub fn unload_plugin(&mut self, name: &str, is_forced: bool) -> ApiResult<()> {
        self.sim.unload_plugin(self.script(), name, is_forced)
    }

    /// The event loop of this simulator's sockets.
    ///
    /// # Errors
    /// When the system cannot create one.
    pub fn event_loop(&self) -> std::io::Result<Rc<EventLoop>> {
        self.sim.event_loop.get()
    }
}
