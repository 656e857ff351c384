//! Lua modules that the embedding program has written in Rust, with mlua.

use std::rc::Rc;

use mlua::{Lua, Table};

use super::startup::load_module;
use crate::host::Sim;
use crate::lua::{LuaError, Stack, push_callback, seal_argument};

/// Makes a module for the Lua state of one script.
type Open = dyn Fn(&Lua) -> mlua::Result<Table>;

/// A module by its name in `require`.
#[derive(Clone)]
pub struct UserModule {
    /// The name by which `require` finds it.
    pub name: String,
    /// Makes the module in a Lua state.
    pub open: Rc<Open>,
}

/// Lets `require` find the modules, before any file and any module of the library.
pub(super) fn install(modules: &[UserModule], sim: &Sim, stack: Stack<'_>) -> Result<(), LuaError> {
    if modules.is_empty() {
        return Ok(());
    }
    load_module(stack, sim, "seal")?;
    push_callback(stack, seal_argument, 0);
    stack.protected_call(1, 0)?;
    Ok(preload(stack.lua(), modules)?)
}

fn preload(lua: &Lua, modules: &[UserModule]) -> mlua::Result<()> {
    let preload: Table = lua.globals().get::<Table>("package")?.get("preload")?;
    for UserModule { name, open } in modules {
        let open = Rc::clone(open);
        preload.raw_set(
            name.as_str(),
            lua.create_function(move |lua, ()| open(lua))?,
        )?;
    }
    Ok(())
}
