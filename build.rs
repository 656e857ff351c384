//! Lists the Lua files of `lua/` for embedding: module name and path. The folders right below `lua/` are rooms; they are not part of names.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

#[allow(clippy::disallowed_methods, reason = "cargo tells a build script its folders through the environment")]
fn main() {
    println!("cargo:rerun-if-changed=lua");
    export_lua();
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it")).join("lua");
    let mut files = Vec::new();
    for room in fs::read_dir(&root).expect("lua/ is part of the package").flatten() {
        collect(&room.path(), &room.path(), &mut files);
    }
    files.sort();
    let mut table = String::from("&[\n");
    for (name, path) in &files {
        writeln!(table, "({name:?}, include_str!({path:?})),").expect("strings take all");
    }
    table.push(']');
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it")).join("lua_files.rs");
    fs::write(out, table).expect("the output folder is writable");
}

/// Lua modules in C find Lua's functions in the program that loads them: they must be in its table of symbols, used or not.
#[allow(clippy::disallowed_methods, reason = "cargo tells a build script its target through the environment")]
fn export_lua() {
    let family = env::var("CARGO_CFG_TARGET_FAMILY").unwrap_or_default();
    let vendor = env::var("CARGO_CFG_TARGET_VENDOR").unwrap_or_default();
    let option = match (family.as_str(), vendor.as_str()) {
        (_, "apple") => "-exported_symbol,_",
        ("unix", _) => "--export-dynamic-symbol=",
        _ => return,
    };
    for prefix in ["lua_", "luaL_"] {
        println!("cargo:rustc-link-arg-bins=-Wl,{option}{prefix}*");
    }
}

/// Module name and path of every Lua file below `dir`, which lies in `room`.
fn collect(room: &Path, dir: &Path, files: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(dir).expect("rooms are folders").flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(room, &path, files);
        } else if path.extension().is_some_and(|extension| extension == "lua") {
            let name = path.strip_prefix(room).expect("collected below the room").with_extension("");
            let name = name.to_str().expect("our file names are ASCII").replace('\\', "/");
            files.push((name, path.display().to_string()));
        }
    }
}
