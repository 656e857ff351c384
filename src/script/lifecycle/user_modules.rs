//! Lua modules that the embedding program has written in Rust, with mlua.

use std::rc::Rc;

use mlua::{Lua, Table};

use crate::script::lua::{self, Stack};

/// Makes a module for the Lua state of one script.
type Open = dyn Fn(&Lua) -> mlua::Result<Table>;

/// A module by the name `require` knows it by.
#[derive(Clone)]
pub(crate) struct UserModule {
    pub name: String,
    pub open: Rc<Open>,
}

/// Lets `require` find the modules, before any file and any module of the library.
pub(in crate::script) fn install(stack: Stack<'_>, lua: &Lua, modules: &[UserModule]) -> mlua::Result<()> {
    if modules.is_empty() {
        return Ok(());
    }
    lua::seal(stack);
    let preload: Table = lua.globals().get::<Table>("package")?.get("preload")?;
    for UserModule { name, open } in modules {
        let open = Rc::clone(open);
        preload.raw_set(name.as_str(), lua.create_function(move |lua, ()| open(lua))?)?;
    }
    Ok(())
}
