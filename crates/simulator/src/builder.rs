//! A simulator in the making.

use std::rc::Rc;

use super::{NativeLanguage, NativeScripts, Parts, Simulator};
use heap::Contained;
use permissions::Permissions;
use script::{
    Console, Debugger, Languages, LuaLanguage, Options, PythonHost, PythonLanguage, Silent, Sim,
    UserModule,
};

/// Collects what a [`Simulator`] is made of; see [`Simulator::builder`].
#[must_use = "nothing is made before `build`"]
pub struct Builder {
    options: Options,
    console: Box<dyn Console>,
    modules: Vec<UserModule>,
    python: Option<Rc<dyn PythonHost>>,
    debugger: Option<Rc<dyn Debugger>>,
    is_observed: bool,
}

impl Default for Builder {
    fn default() -> Self {
        Self {
            options: Options::default(),
            console: Box::new(Silent),
            modules: Vec::new(),
            python: None,
            debugger: None,
            is_observed: false,
        }
    }
}

impl Builder {
    /// How the simulator behaves.
    pub fn options(self, options: Options) -> Self {
        Self { options, ..self }
    }

    /// Permissions of scripts outside of the simulator; all without this call.
    ///
    /// ```
    /// use swanilda::{Permissions, ScriptKind, Simulator};
    ///
    /// let mut simulator = Simulator::builder().permissions(Permissions::none()).build();
    /// simulator.add_script(ScriptKind::Customization, "", b"assert(not io.open('Cargo.toml'))")?;
    /// assert_eq!(simulator.errors(), 0);
    /// # Ok::<(), swanilda::Error>(())
    /// ```
    pub fn permissions(self, permissions: Permissions) -> Self {
        Self {
            options: Options {
                permissions,
                ..self.options
            },
            ..self
        }
    }

    /// Where prints and log lines go; nowhere without this.
    pub fn console(self, console: Box<dyn Console>) -> Self {
        Self { console, ..self }
    }

    /// Adds a Lua module, written with [mlua]: scripts get what `open` returns by `require 'name'`. It goes before files and
    /// modules of that name.
    ///
    /// Each script has a Lua state of its own, so `open` is called once for each script that requires the module. What its functions
    /// and methods raise reaches scripts as strings with the line of the call, and a panic is an error of the script.
    ///
    /// ```
    /// use swanilda::{ScriptKind, Simulator};
    ///
    /// let mut simulator = Simulator::builder()
    ///     .lua_module("mine", |lua| {
    ///         let module = lua.create_table()?;
    ///         module.set("double", lua.create_function(|_, x: f64| Ok(2.0 * x))?)?;
    ///         Ok(module)
    ///     })
    ///     .build();
    /// simulator.add_script(ScriptKind::Customization, "", b"assert(require('mine').double(4) == 8)")?;
    /// assert_eq!(simulator.errors(), 0);
    /// # Ok::<(), swanilda::Error>(())
    /// ```
    pub fn lua_module(
        mut self,
        name: impl Into<String>,
        open: impl Fn(&mlua::Lua) -> mlua::Result<mlua::Table> + 'static,
    ) -> Self {
        self.modules.push(UserModule {
            name: name.into(),
            open: Rc::new(open),
        });
        self
    }

    /// The Python of this program: scripts in Python run there instead of in processes of their own.
    pub fn python(self, host: Rc<dyn PythonHost>) -> Self {
        Self {
            python: Some(host),
            ..self
        }
    }

    /// Who decides where Lua scripts stop.
    pub fn debugger(self, debugger: Rc<dyn Debugger>) -> Self {
        Self {
            debugger: Some(debugger),
            ..self
        }
    }

    /// Keeps what happens from the beginning, for [`Simulator::take_happenings`].
    pub fn observed(self) -> Self {
        Self {
            is_observed: true,
            ..self
        }
    }

    /// A simulator with an empty scene.
    pub fn build(self) -> Simulator {
        let Self {
            options,
            console,
            modules,
            python,
            debugger,
            is_observed,
        } = self;
        let parts = Contained::new(|| {
            let native_scripts = Rc::<NativeScripts>::default();
            let lua = LuaLanguage::new(modules);
            let languages = Languages::new(vec![
                Box::new(lua.clone()),
                Box::new(PythonLanguage::new(lua, python)),
                Box::new(NativeLanguage(Rc::clone(&native_scripts))),
            ]);
            let inner = Options {
                permissions: options.permissions.counted_apart(),
                ..options.clone()
            };
            let sim = Sim::new(inner, modules::registry(), console, languages);
            if let Some(debugger) = debugger {
                // The simulator was just made, so it has none.
                let _ = sim.scripts.debugger.set(debugger);
            }
            if is_observed {
                sim.keep_happenings();
            }
            Parts {
                native_scripts,
                sim,
            }
        });
        Simulator::with_main_and_sandbox(parts, options)
    }
}
