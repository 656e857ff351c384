//! The Lua files below this folder, as text: the part of the library that is written in Lua.
//!
//! The folders right below this one group files; they are not part of the names that `require` takes.

/// `(module, text)` of every file, sorted by name.
pub static FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/lua_files.rs"));
