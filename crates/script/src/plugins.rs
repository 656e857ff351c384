//! Native plugins of a simulator: where they are found, which scripts use them, which changes they are notified of, what they may call.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::{Rc, Weak};

use super::error::{ApiError, ApiResult};
use super::log::verbosity;
use crate::host::{Script, Sim};
use c_interface::{Callback, Host, Moment, Plugin, Plugins};
use scene::object::script_object::ScriptType;
use scene::{Data, Journal, Mark, Topic, Topics};

/// The plugins that are loaded, and who uses them. A simulator without plugins has none of this.
#[derive(Default)]
struct LoadedPlugins {
    plugins: Plugins,
    /// The scripts that use a plugin, by its name.
    users: RefCell<BTreeMap<String, BTreeSet<i64>>>,
    /// What happened since the last pass, as bits.
    changes: Cell<i32>,
    marks: RefCell<Marks>,
}

/// Changes of the scene that plugins are notified of, with their bits.
struct Marks([(Mark, i32); 3]);

impl Default for Marks {
    fn default() -> Self {
        let mark = |topic| Mark::new(Topics::NONE.with(topic));
        Self([
            (mark(Topic::Removed), OBJECTS_REMOVED),
            (mark(Topic::Added), OBJECTS_ADDED),
            (mark(Topic::Selection), SELECTION_CHANGED),
        ])
    }
}

impl Marks {
    /// The bits of what has changed since the last call.
    fn changes(&mut self, journal: &Journal) -> i32 {
        let changed = self
            .0
            .iter_mut()
            .filter_map(|(mark, bit)| journal.changed_since(mark).then_some(*bit));
        changed.fold(0, |bits, bit| bits | bit)
    }
}

/// Bits of [`LoadedPlugins::changes`].
const OBJECTS_REMOVED: i32 = 1;
const OBJECTS_ADDED: i32 = 1 << 1;
const MODEL_LOADED: i32 = 1 << 2;
const SCENE_LOADED: i32 = 1 << 3;
const SELECTION_CHANGED: i32 = 1 << 9;
const SIMULATION_STARTED: i32 = 1 << 11;
const SIMULATION_ENDED: i32 = 1 << 12;

impl Sim {
    /// The plugin of that name, `simX` or `simX-version`, which is loaded if it is not yet. None where it cannot be loaded; the log says
    /// why.
    pub(crate) fn load_plugin(
        self: &Rc<Self>,
        script: &Rc<Script>,
        name: &str,
    ) -> Option<Rc<Plugin>> {
        let namespace = namespace(name);
        let loaded = self.loaded_plugins();
        let plugin = match loaded.plugins.get(namespace) {
            Some(plugin) => Ok(plugin),
            None => self.options.plugin_file(name).and_then(|file| {
                let tape = self.options.permissions.tape();
                tape.lacks(&format!("what the native plugin '{name}' does"));
                loaded.plugins.note_calls(self.options.plugin_note.clone());
                loaded
                    .plugins
                    .load(self.plugin_host(Some(script)), namespace, &file)
            }),
        };
        match plugin {
            Ok(plugin) => {
                loaded
                    .users
                    .borrow_mut()
                    .entry(namespace.to_owned())
                    .or_default()
                    .insert(script.id);
                Some(plugin)
            }
            Err(reason) => {
                self.log(verbosity::ERRORS, &format!("plugin {name}: {reason}"));
                None
            }
        }
    }

    /// The plugins, which learn of the end of each script from now on.
    fn loaded_plugins(&self) -> Rc<LoadedPlugins> {
        self.modules.states.existing().unwrap_or_else(|| {
            self.scripts.at_end(Self::release_plugins_of);
            self.modules.states.get()
        })
    }

    /// Name and version of a native plugin by its place in the order in which they were loaded.
    pub(crate) fn plugin_by_place(&self, place: usize) -> Option<(String, i32)> {
        let loaded: Rc<LoadedPlugins> = self.modules.states.existing()?;
        let plugins = loaded.plugins.all();
        let plugin = plugins.get(place)?;
        Some((plugin.name.clone(), plugin.version()))
    }

    /// Whether a plugin of CoppeliaSim is a module here, and no library of that name is to be found.
    pub(crate) fn has_module_for_plugin(&self, name: &str) -> bool {
        self.modules.registry.module(namespace(name)).is_some()
            && self.options.plugin_file(name).is_err()
    }

    /// The names of the functions for scripts that the program has registered which has loaded the simulator as a library.
    pub(crate) fn functions_of_program(&self) -> Vec<String> {
        let loaded = self.modules.states.existing::<LoadedPlugins>();
        let program = loaded.and_then(|loaded| loaded.plugins.program());
        program.map_or_else(Vec::new, |program| program.functions())
    }

    /// Calls a function of a plugin, or of the program that has loaded the simulator, by its place, for a script.
    ///
    /// # Errors
    /// When the plugin was unloaded, or its error.
    pub(crate) fn call_plugin(
        self: &Rc<Self>,
        script: &Rc<Script>,
        plugin: Option<&str>,
        function: usize,
        args: Vec<Data>,
    ) -> ApiResult<Vec<Data>> {
        let loaded = self.loaded_plugins();
        let plugin = match plugin {
            Some(name) => loaded.plugins.get(name),
            None => loaded.plugins.program(),
        };
        let plugin =
            plugin.ok_or_else(|| ApiError::Other("the plugin is not loaded any more.".into()))?;
        let object = self.object_of(script);
        let results = loaded.plugins.call(
            self.plugin_host(Some(script)),
            &plugin,
            function,
            (script.id, object),
            args,
        );
        results.map_err(ApiError::Plugin)
    }

    /// The object that a script is attached to, or -1.
    fn object_of(&self, script: &Script) -> i64 {
        let scene = self.scene.borrow();
        let parent = |handle| scene.object(handle).ok().and_then(scene::Object::parent);
        script
            .owner()
            .or_else(|| script.object.and_then(parent))
            .map_or(-1, scene::Handle::raw)
    }

    /// A script uses a plugin no longer. It is unloaded with its last user, or at once if that is forced.
    ///
    /// # Errors
    /// When the plugin is not loaded, or its code is running.
    pub(crate) fn unload_plugin(
        self: &Rc<Self>,
        script: &Script,
        name: &str,
        is_forced: bool,
    ) -> ApiResult<()> {
        let loaded = self.loaded_plugins();
        let error = |text: &str| ApiError::Other(text.to_owned());
        let plugin = loaded
            .plugins
            .get(namespace(name))
            .ok_or_else(|| error("the plugin is not loaded."))?;
        if plugin.is_running() {
            return Err(error("a function of the plugin is running."));
        }
        loaded.forget(&plugin.name, script.id);
        if is_forced {
            loaded.users.borrow_mut().remove(&plugin.name);
        }
        self.unload_unused(&loaded);
        Ok(())
    }

    /// A script's state is about to end, and with it what it uses.
    fn release_plugins_of(self: &Rc<Self>, script: &Script) {
        let Some(loaded) = self.modules.states.existing::<LoadedPlugins>() else {
            return;
        };
        if script.current_runtime().is_none() {
            return;
        }
        self.notify_plugins(
            Moment::ScriptStateAboutToBeDestroyed,
            [
                numbers::low_i32(script.id),
                numbers::low_i32(script.id),
                0,
                0,
            ],
        );
        let names: Vec<String> = loaded.users.borrow().keys().cloned().collect();
        names.iter().for_each(|name| loaded.forget(name, script.id));
        self.unload_unused(&loaded);
    }

    /// Unloads what nobody uses. A plugin whose code is running stays until the next pass.
    fn unload_unused(self: &Rc<Self>, loaded: &LoadedPlugins) {
        for plugin in loaded.plugins.all() {
            let is_used = loaded.users.borrow().contains_key(&plugin.name);
            if !is_used && !plugin.is_running() {
                loaded.plugins.unload(self.plugin_host(None), &plugin);
            }
        }
    }

    /// Unloads all plugins, at the end of the simulator.
    pub fn unload_plugins(self: &Rc<Self>) {
        let Some(loaded) = self.modules.states.existing::<LoadedPlugins>() else {
            return;
        };
        loaded.users.borrow_mut().clear();
        self.unload_unused(&loaded);
    }

    /// Sends a message to the plugins.
    pub(crate) fn notify_plugins(self: &Rc<Self>, moment: Moment, values: [i32; 4]) {
        let Some(loaded) = self.modules.states.existing::<LoadedPlugins>() else {
            return;
        };
        loaded.changes.set(loaded.changes.get() | change(moment));
        loaded.plugins.send(self.plugin_host(None), moment, values);
    }

    /// The message of each turn of the application's loop.
    pub(crate) fn notify_plugins_of_pass(self: &Rc<Self>) {
        let Some(loaded) = self.modules.states.existing::<LoadedPlugins>() else {
            return;
        };
        self.unload_unused(&loaded);
        let changes = loaded.changes.take()
            | loaded
                .marks
                .borrow_mut()
                .changes(self.scene.borrow().journal());
        self.notify_plugins(Moment::Pass, [changes, 0, 0, 0]);
    }

    /// The simulator as the host of a program's calls, in the name of the sandbox.
    pub fn c_host(self: &Rc<Self>) -> Rc<dyn Host> {
        self.plugin_host(None)
    }

    fn plugin_host(self: &Rc<Self>, script: Option<&Rc<Script>>) -> Rc<dyn Host> {
        let script = script
            .cloned()
            .or_else(|| self.scripts.detached(ScriptType::Sandbox));
        Rc::new(ScriptHost {
            sim: Rc::downgrade(self),
            script,
        })
    }
}

impl LoadedPlugins {
    fn forget(&self, name: &str, script: i64) {
        let mut users = self.users.borrow_mut();
        let Some(scripts) = users.get_mut(name) else {
            return;
        };
        scripts.remove(&script);
        if scripts.is_empty() {
            users.remove(name);
        }
    }
}

/// The name without its version.
fn namespace(name: &str) -> &str {
    name.split('-').next().unwrap_or(name)
}

fn change(moment: Moment) -> i32 {
    match moment {
        Moment::ModelLoaded => MODEL_LOADED,
        Moment::SceneLoaded => SCENE_LOADED,
        Moment::SimulationAboutToStart => SIMULATION_STARTED,
        Moment::SimulationEnded => SIMULATION_ENDED,
        _ => 0,
    }
}

/// The simulator as plugins see it, while they run on behalf of a script.
struct ScriptHost {
    sim: Weak<Sim>,
    script: Option<Rc<Script>>,
}

impl ScriptHost {
    fn sim(&self) -> Result<Rc<Sim>, String> {
        self.sim
            .upgrade()
            .ok_or_else(|| "the simulator is gone".to_owned())
    }

    /// The script with that handle: -1 for the sandbox, -2 for the main script.
    fn script(&self, sim: &Rc<Sim>, handle: i64) -> Result<Rc<Script>, String> {
        let script = match handle {
            -1 => sim.scripts.detached(ScriptType::Sandbox),
            -2 => sim.scripts.detached(ScriptType::Main),
            handle => sim.script(handle),
        };
        script.ok_or_else(|| ApiError::NoSuchScript.to_string())
    }
}

impl Host for ScriptHost {
    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        let sim = self.sim()?;
        let script = self
            .script
            .as_ref()
            .ok_or_else(|| ApiError::NoSuchScript.to_string())?;
        sim.call_api(script, function, args)
            .map_err(|error| error.to_string())
    }

    fn call_script(&self, script: i64, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        let sim = self.sim()?;
        let script = self.script(&sim, script)?;
        sim.call_for_program(&script, function, args)
    }

    fn execute(&self, script: i64, text: &[u8]) -> Result<Vec<Data>, String> {
        let sim = self.sim()?;
        let script = self.script(&sim, script)?;
        sim.execute_string(&script, text)
            .map_err(|error| error.to_string())
    }

    fn register_function(&self, name: String, callback: Callback) -> Result<bool, String> {
        let loaded = self.sim()?.loaded_plugins();
        Ok(loaded.plugins.register_of_program(name, callback))
    }

    fn log(&self, origin: &str, level: i64, text: &str) {
        if let Ok(sim) = self.sim() {
            sim.log_as(origin, level, text);
        }
    }
}
